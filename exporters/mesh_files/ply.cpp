// SPDX-License-Identifier: BSD-3-Clause
// Writes PLY files: a header that names the columns, then little-endian rows.
#include <fmt/format.h>

#include "exporters/mesh_files/binary_rows.h"
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

}  // namespace meniscus
