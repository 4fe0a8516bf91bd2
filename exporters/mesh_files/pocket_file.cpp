// SPDX-License-Identifier: BSD-3-Clause
// Divides the mesh of all pockets into objects of a mesh file, one a pocket.
#include "exporters/mesh_files/pocket_file.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/index.h"
#include "core/color/named_colors.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {
namespace {

std::array<std::uint8_t, 3> bytes_of(const glm::vec3& color) {
  std::array<std::uint8_t, 3> bytes{};
  for (int k = 0; k < 3; ++k) bytes[k] = static_cast<std::uint8_t>(std::lround(255.0f * color[k]));
  return bytes;
}

}  // namespace

MeshFile pocket_file(const TriangleMesh& mesh) {
  MeshFile file;
  file.about =
      fmt::format("Meniscus " MENISCUS_VERSION ": pockets, tolerance {} Angstrom, in Angstrom", mesh.tolerance);
  std::vector<std::uint32_t> vertex(mesh.positions.size(), kNone);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t pocket = mesh.component[t];
    while (file.objects.size() <= pocket) {
      const std::size_t rank = file.objects.size() + 1;
      file.objects.emplace_back();
      file.objects.back().name = fmt::format("pocket {}", rank);
      file.objects.back().numbers = {{"pocket", {}}};
    }
    FileObject& object = file.objects[pocket];
    std::array<std::uint32_t, 3> triangle{};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[t][k];
      if (vertex[v] == kNone) {
        vertex[v] = static_cast<std::uint32_t>(object.positions.size());
        object.positions.emplace_back(mesh.positions[v]);
        object.normals.emplace_back(mesh.normals[v]);
        object.colors.push_back(bytes_of(categorical_color(pocket)));
        object.numbers.front().values.push_back(static_cast<float>(pocket + 1));
        object.atom.push_back(kNone);
        object.kind.push_back(mesh.kind[t]);
      }
      triangle[k] = vertex[v];
    }
    object.triangles.push_back(triangle);
    object.component.push_back(pocket);
  }
  return file;
}

}  // namespace meniscus
