// SPDX-License-Identifier: BSD-3-Clause
// Leaves out triangles, and what only they used.
#include <algorithm>
#include <utility>

#include "core/mesh/triangle_mesh.h"

namespace meniscus {
namespace {

/// Keeps the rows of a table that `keep` marks, in order.
template <class T>
void keep_rows(std::vector<T>& table, const std::vector<bool>& keep) {
  std::size_t next = 0;
  for (std::size_t row = 0; row < table.size(); ++row)
    if (keep[row]) table[next++] = table[row];
  table.resize(next);
}

/// The new place of each row that is kept, kNone for others.
std::vector<std::uint32_t> new_places(const std::vector<bool>& keep) {
  std::vector<std::uint32_t> place(keep.size(), kNone);
  std::uint32_t next = 0;
  for (std::size_t row = 0; row < keep.size(); ++row)
    if (keep[row]) place[row] = next++;
  return place;
}

void keep_rows_of_triangles(TriangleMesh& mesh, const std::vector<bool>& keep, const std::vector<bool>& changed) {
  const std::vector<std::uint32_t> place = new_places(keep);
  std::vector<bool> sharp;
  for (std::uint32_t& corner : mesh.sharp_corners) {
    const std::uint32_t t = corner / 3;
    sharp.push_back(keep[t] && (changed.empty() || !changed[t]));
    if (keep[t]) corner = 3 * place[t] + corner % 3;
  }
  keep_rows(mesh.sharp_corners, sharp);
  keep_rows(mesh.sharp_corner_normals, sharp);
  keep_rows(mesh.triangles, keep);
  keep_rows(mesh.kind, keep);
  for (std::vector<std::uint32_t>* table : {&mesh.face, &mesh.patch, &mesh.component, &mesh.atom})
    keep_rows(*table, keep);
}

std::vector<std::uint32_t> keep_used_vertices(TriangleMesh& mesh) {
  std::vector<bool> used(mesh.positions.size(), false);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) used[v] = true;
  const std::vector<std::uint32_t> place = new_places(used);
  keep_rows(mesh.positions, used);
  keep_rows(mesh.normals, used);
  for (auto& t : mesh.triangles)
    for (std::uint32_t& v : t) v = place[v];
  std::erase_if(mesh.sharp_edges, [&](const auto& e) { return !used[e[0]] || !used[e[1]]; });
  for (auto& e : mesh.sharp_edges)
    for (std::uint32_t& v : e) v = place[v];
  return place;
}

}  // namespace

std::vector<std::uint32_t> keep_triangles(TriangleMesh& mesh, const std::vector<bool>& keep,
                                          const std::vector<bool>& changed) {
  mesh.corner_count = mesh.border_point_count = 0;
  keep_rows_of_triangles(mesh, keep, changed);
  return keep_used_vertices(mesh);
}

TriangleMesh shown_part(TriangleMesh mesh, const Coloring& coloring) {
  std::vector<bool> shown;
  for (const std::uint32_t a : mesh.atom) shown.push_back(coloring.shows(a));
  if (std::ranges::find(shown, false) == shown.end()) return mesh;
  keep_triangles(mesh, shown);
  mesh.partly_hidden = true;
  return mesh;
}

}  // namespace meniscus
