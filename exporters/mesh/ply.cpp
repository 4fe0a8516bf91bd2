// SPDX-License-Identifier: BSD-3-Clause
// The PLY writer (G. Turk 1994): text header, little-endian rows.
#include "exporters/mesh/ply.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "exporters/mesh/mesh_colors.h"

namespace meniscus {
namespace {

class Rows {
 public:
  template <class T>
  void put(T value) {
    const auto at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

std::uint8_t byte_of(float channel) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(channel, 0.0f, 1.0f)));
}

}  // namespace

void write_ply(const std::string& path, Existing existing, const TriangleMesh& mesh, const Coloring& coloring,
               const std::vector<AtomScalar>& scalars) {
  std::string header = fmt::format("ply\nformat binary_little_endian 1.0\ncomment Meniscus " MENISCUS_VERSION
                                   ": solvent-excluded surface, tolerance {} Angstrom\nelement vertex {}\n",
                                   mesh.tolerance, mesh.positions.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) header += fmt::format("property float {}\n", name);
  for (const char* name : {"red", "green", "blue"}) header += fmt::format("property uchar {}\n", name);
  for (const AtomScalar& scalar : scalars) header += fmt::format("property float {}\n", scalar.name);
  if (coloring.volume) header += "property float map_value\n";
  for (const char* name : {"ses_kind", "ses_component"}) {
    header += fmt::format("property float {}\n", name);
  }
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangles.size());

  const auto colors = vertex_colors(mesh, coloring);
  const auto atoms = vertex_atoms(mesh);
  const auto map_values = coloring.volume ? vertex_map_values(mesh, *coloring.volume) : std::vector<float>();
  std::vector<std::size_t> triangle_of(mesh.positions.size(), 0);
  for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
    for (const std::uint32_t v : mesh.triangles[t]) triangle_of[v] = t;
  }
  Rows rows;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (int k = 0; k < 3; ++k) rows.put(static_cast<float>(mesh.positions[v][k]));
    for (int k = 0; k < 3; ++k) rows.put(static_cast<float>(mesh.normals[v][k]));
    for (int k = 0; k < 3; ++k) rows.put(byte_of(colors[v][k]));
    for (const AtomScalar& scalar : scalars) rows.put(scalar.values[atoms[v]]);
    if (coloring.volume) rows.put(map_values[v]);
    rows.put(static_cast<float>(mesh.kind[triangle_of[v]]));
    rows.put(static_cast<float>(mesh.component[triangle_of[v]]));
  }
  for (const auto& t : mesh.triangles) {
    rows.put(std::uint8_t{3});
    for (const std::uint32_t v : t) rows.put(static_cast<std::int32_t>(v));
  }
  OutputFile file(path, existing);
  file.write(header);
  file.write(rows.bytes());
  file.commit();
}

}  // namespace meniscus
