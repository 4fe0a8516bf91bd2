// SPDX-License-Identifier: BSD-3-Clause
// Writes a mesh of a scene as binary PLY: a header that names the columns, then little-endian rows (G. Turk 1994).
#include "exporters/path_tracers/ply_mesh.h"

#include <string>

#include <fmt/format.h>

#include "exporters/mesh_files/binary_rows.h"

namespace meniscus::path_tracers {

void write_mesh(OutputFile& file, const SceneMesh& mesh, bool with_colors) {
  std::string header = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", mesh.positions.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) header += fmt::format("property float {}\n", name);
  if (with_colors)
    for (const char* name : {"r", "g", "b"}) header += fmt::format("property float {}\n", name);
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangles.size());
  BinaryRows rows;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    rows.put(mesh.positions[v]);
    rows.put(mesh.normals[v]);
    if (with_colors) rows.put(mesh.colors[v]);
  }
  for (const auto& triangle : mesh.triangles) {
    rows.put(std::uint8_t{3});
    rows.put(triangle);
  }
  file.write(header);
  file.write(rows.bytes());
}

}  // namespace meniscus::path_tracers
