// SPDX-License-Identifier: BSD-3-Clause
// Meshes the boundaries of all pockets at once, and turns them over, so that they face outwards.
#include "core/mesh/pocket_mesh.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/mesh/tessellate.h"
#include "core/queries/combine.h"

namespace meniscus {
namespace {

void turn_over(TriangleMesh& mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  for (glm::dvec3& normal : mesh.normals) normal = -normal;
  // Corners are numbered along their triangles, and stay in ascending order.
  for (std::size_t n = 0; n < mesh.sharp_corners.size(); ++n) {
    mesh.sharp_corner_normals[n] = -mesh.sharp_corner_normals[n];
    if (mesh.sharp_corners[n] % 3 == 0) continue;
    const bool both = mesh.sharp_corners[n] % 3 == 1 && n + 1 < mesh.sharp_corners.size() &&
                      mesh.sharp_corners[n + 1] == mesh.sharp_corners[n] + 1;
    if (both) {
      mesh.sharp_corner_normals[n + 1] = -mesh.sharp_corner_normals[n + 1];
      std::swap(mesh.sharp_corner_normals[n], mesh.sharp_corner_normals[n + 1]);
      ++n;
    } else {
      mesh.sharp_corners[n] += mesh.sharp_corners[n] % 3 == 1 ? 1 : -1;
    }
  }
}

}  // namespace

TriangleMesh pocket_mesh(const Pockets& pockets, double tolerance) {
  if (pockets.pockets.empty()) throw RequestError("there are no pockets, so there is no mesh to write");
  Surface all;
  std::vector<std::uint32_t> pocket_of_component;
  for (std::uint32_t n = 0; n < pockets.pockets.size(); ++n) {
    const Surface& surface = pockets.pockets[n].surface;
    append(all, surface);
    pocket_of_component.insert(pocket_of_component.end(), surface.components.size(), n);
  }
  TriangleMesh mesh = tessellate(all, {.tolerance = tolerance, .split_colors = false});
  for (std::uint32_t& component : mesh.component) component = pocket_of_component[component];
  turn_over(mesh);
  return mesh;
}

}  // namespace meniscus
