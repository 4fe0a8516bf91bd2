// SPDX-License-Identifier: BSD-3-Clause
// Chains half-borders by their vertices and groups loops by which side of each other they lie on.
#include "core/surface/loops.h"

#include <algorithm>
#include <utility>

#include "core/surface/spherical.h"
#include "core/math/union_find.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

std::uint32_t vertex_at(std::span<const Border> borders, HalfBorder h, int end) {
  return borders[border_of(h)].vertex[is_backwards(h) ? 1 - end : end];
}

void chain_loops(std::span<const Border> borders, std::span<const HalfBorder> walk, PatchFaces& faces) {
  // By begin, so that the next one is found quickly on atoms with thousands of borders, too.
  std::vector<std::pair<std::uint32_t, HalfBorder>> open;
  open.reserve(walk.size());
  for (const HalfBorder h : walk) open.emplace_back(vertex_at(borders, h, 0), h);
  std::sort(open.begin(), open.end());
  std::vector<char> taken(open.size(), 0);
  faces.half_borders.reserve(open.size());
  for (std::size_t start = 0; start < open.size(); ++start) {
    if (taken[start]) continue;
    const std::size_t first = faces.half_borders.size();
    const std::uint32_t home = open[start].first;
    taken[start] = 1;
    faces.half_borders.push_back(open[start].second);
    for (std::uint32_t at = vertex_at(borders, open[start].second, 1); at != home;) {
      std::size_t next = static_cast<std::size_t>(
          std::lower_bound(open.begin(), open.end(), std::pair<std::uint32_t, HalfBorder>(at, 0)) - open.begin());
      while (next < open.size() && open[next].first == at && taken[next]) ++next;
      if (next == open.size() || open[next].first != at) {
        faces.closed = false;
        break;
      }
      taken[next] = 1;
      faces.half_borders.push_back(open[next].second);
      at = vertex_at(borders, open[next].second, 1);
    }
    faces.loop_sizes.push_back(static_cast<std::uint32_t>(faces.half_borders.size() - first));
  }
}

std::vector<std::vector<SphereArc>> arcs_of_loops(std::span<const Border> borders, const PatchFaces& faces,
                                                  const glm::dvec3& center, double radius, bool seen_from_inside) {
  std::vector<std::vector<SphereArc>> loops(faces.loop_sizes.size());
  for (std::size_t l = 0, h = 0; l < loops.size(); ++l) {
    for (std::uint32_t n = 0; n < faces.loop_sizes[l]; ++n, ++h) {
      const HalfBorder half = faces.half_borders[h];
      loops[l].push_back(sphere_arc(borders[border_of(half)], is_backwards(half) != seen_from_inside, center, radius));
    }
    if (seen_from_inside) std::reverse(loops[l].begin(), loops[l].end());
  }
  return loops;
}

// Two loops bound the same piece if each lies on the other's left and no third separates them.
void group_loops(const std::vector<std::vector<SphereArc>>& loops, PatchFaces& faces) {
  const std::size_t count = loops.size();
  std::vector<std::vector<char>> left(count, std::vector<char>(count, 1));  // [m][k]: loop m lies left of loop k
  bool one_piece = true;
  for (std::size_t m = 0; m < count; ++m)
    for (std::size_t k = 0; k < count; ++k) {
      if (m == k) continue;
      left[m][k] = lies_left_of(loops[m], loops[k]);
      one_piece = one_piece && left[m][k];
    }
  if (one_piece) return;  // as a rule; the question below takes the cube of the number of loops
  UnionFind same(count);
  for (std::size_t m = 0; m < count; ++m)
    for (std::size_t n = m + 1; n < count; ++n) {
      bool together = left[m][n] && left[n][m];
      for (std::size_t k = 0; k < count && together; ++k) together = k == m || k == n || left[m][k] == left[n][k];
      if (together) same.unite(static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(n));
    }
  faces.face_count = 0;
  std::vector<std::uint32_t> number(count, kNone);
  for (std::uint32_t l = 0; l < count; ++l) {
    const std::uint32_t root = same.find(l);
    if (number[root] == kNone) number[root] = faces.face_count++;
    faces.loop_face[l] = number[root];
  }
}

}  // namespace

PatchFaces chain_faces(std::span<const Border> borders, std::span<const HalfBorder> walk, const glm::dvec3& center,
                       double radius, bool seen_from_inside) {
  PatchFaces faces;
  chain_loops(borders, walk, faces);
  faces.loop_face.assign(faces.loop_sizes.size(), 0);
  faces.face_count = walk.empty() && seen_from_inside ? 0 : 1;
  if (faces.loop_sizes.size() > 1 && faces.closed)
    group_loops(arcs_of_loops(borders, faces, center, radius, seen_from_inside), faces);
  return faces;
}

}  // namespace meniscus
