// SPDX-License-Identifier: BSD-3-Clause
// Writes the mesh formats that are rows of bytes: PLY and STL.
#include <array>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {

void write_ply(OutputFile& file, const MeshFile& mesh) {
  const FileObject& object = mesh.objects.front();
  std::string header = fmt::format("ply\nformat binary_little_endian 1.0\ncomment {}\nelement vertex {}\n", mesh.about,
                                   object.positions.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) header += fmt::format("property float {}\n", name);
  for (const char* name : {"red", "green", "blue"}) header += fmt::format("property uchar {}\n", name);
  for (const VertexNumbers& column : object.numbers) header += fmt::format("property float {}\n", column.name);
  header +=
      fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", object.triangles.size());
  BinaryRows rows;
  for (std::size_t v = 0; v < object.positions.size(); ++v) {
    rows.put(object.positions[v]);
    rows.put(object.normals[v]);
    rows.put(object.colors[v]);
    for (const VertexNumbers& column : object.numbers) rows.put(column.values[v]);
  }
  for (const auto& triangle : object.triangles) {
    rows.put(std::uint8_t{3});
    rows.put(triangle);
  }
  file.write(header);
  file.write(rows.bytes());
}

void write_stl(OutputFile& file, const MeshFile& mesh) {
  const FileObject& object = mesh.objects.front();
  if (object.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    throw CapacityError("STL holds 4,294,967,295 triangles at most; ask for a coarser mesh");
  std::array<char, 80> about{};  // it must not begin with "solid", as text files do
  const std::string line = mesh.about.substr(0, about.size());
  std::ranges::copy(line, about.begin());
  BinaryRows rows;
  rows.put(about);
  rows.put(static_cast<std::uint32_t>(object.triangles.size()));
  for (const auto& [a, b, c] : object.triangles) {
    const glm::vec3 &x = object.positions[a], &y = object.positions[b], &z = object.positions[c];
    const glm::dvec3 cross = glm::cross(glm::dvec3(y) - glm::dvec3(x), glm::dvec3(z) - glm::dvec3(x));
    const double size = glm::length(cross);
    rows.put(size > 0.0 ? glm::vec3(cross / size) : glm::vec3(0.0f));
    for (const glm::vec3& corner : {x, y, z}) rows.put(corner);
    rows.put(std::uint16_t{0});
  }
  file.write(rows.bytes());
}

}  // namespace meniscus
