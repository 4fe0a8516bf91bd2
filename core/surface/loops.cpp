// SPDX-License-Identifier: BSD-3-Clause
// Chains half-borders by their vertices and groups loops by which side of each other they lie on.
#include "core/surface/loops.h"

#include <algorithm>

#include "core/math/union_find.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

std::uint32_t vertex_at(std::span<const Border> borders, HalfBorder h, int end) {
  return borders[border_of(h)].vertex[is_backwards(h) ? 1 - end : end];
}

}  // namespace

void LoopChainer::chain_loops(std::span<const Border> borders, std::span<const HalfBorder> walk) {
  // The list is sorted by begin, so that the next half-border is found quickly on atoms with thousands of borders.
  open_.clear();
  for (const HalfBorder h : walk) open_.emplace_back(vertex_at(borders, h, 0), h);
  std::sort(open_.begin(), open_.end());
  taken_.assign(open_.size(), 0);
  for (std::size_t start = 0; start < open_.size(); ++start) {
    if (taken_[start]) continue;
    const std::size_t first = faces_.half_borders.size();
    const std::uint32_t home = open_[start].first;
    taken_[start] = 1;
    faces_.half_borders.push_back(open_[start].second);
    for (std::uint32_t at = vertex_at(borders, open_[start].second, 1); at != home;) {
      std::size_t next = static_cast<std::size_t>(
          std::lower_bound(open_.begin(), open_.end(), std::pair<std::uint32_t, HalfBorder>(at, 0)) - open_.begin());
      while (next < open_.size() && open_[next].first == at && taken_[next]) ++next;
      if (next == open_.size() || open_[next].first != at) {
        faces_.closed = false;
        break;
      }
      taken_[next] = 1;
      faces_.half_borders.push_back(open_[next].second);
      at = vertex_at(borders, open_[next].second, 1);
    }
    faces_.loop_sizes.push_back(static_cast<std::uint32_t>(faces_.half_borders.size() - first));
  }
}

void LoopChainer::list_arcs(std::span<const Border> borders, const Sphere& sphere) {
  arcs_.clear();
  first_arc_.assign(1, 0);
  std::size_t h = 0;
  for (const std::uint32_t size : faces_.loop_sizes) {
    for (const std::size_t past = h + size; h < past; ++h) {
      const HalfBorder half = faces_.half_borders[h];
      arcs_.push_back(sphere_arc(borders[border_of(half)], is_backwards(half) != sphere.seen_from_inside, sphere.center,
                                 sphere.radius));
    }
    if (sphere.seen_from_inside) std::reverse(arcs_.begin() + first_arc_.back(), arcs_.end());
    first_arc_.push_back(static_cast<std::uint32_t>(arcs_.size()));
  }
}

// Two loops bound the same piece if each lies on the other's left and no third separates them.
void LoopChainer::group_loops() {
  const std::size_t count = faces_.loop_sizes.size();
  const auto arcs_of = [&](std::size_t loop) {
    return std::span<const SphereArc>(arcs_.data() + first_arc_[loop], arcs_.data() + first_arc_[loop + 1]);
  };
  left_.assign(count * count, 1);
  bool one_piece = true;
  for (std::size_t m = 0; m < count; ++m)
    for (std::size_t k = 0; k < count; ++k) {
      if (m == k) continue;
      left_[m * count + k] = lies_left_of(arcs_of(m), arcs_of(k));
      one_piece = one_piece && left_[m * count + k];
    }
  if (one_piece) return;  // as a rule; the search below takes the cube of the number of loops
  const auto left = [&](std::size_t m, std::size_t k) { return left_[m * count + k] != 0; };
  UnionFind same(count);
  for (std::size_t m = 0; m < count; ++m)
    for (std::size_t n = m + 1; n < count; ++n) {
      bool together = left(m, n) && left(n, m);
      for (std::size_t k = 0; k < count && together; ++k) together = k == m || k == n || left(m, k) == left(n, k);
      if (together) same.unite(static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(n));
    }
  faces_.face_count = 0;
  std::vector<std::uint32_t> number(count, kNone);
  for (std::uint32_t l = 0; l < count; ++l) {
    const std::uint32_t root = same.find(l);
    if (number[root] == kNone) number[root] = faces_.face_count++;
    faces_.loop_face[l] = number[root];
  }
}

const PatchFaces& LoopChainer::chain(std::span<const Border> borders, std::span<const HalfBorder> walk,
                                     const glm::dvec3& center, double radius, bool seen_from_inside) {
  faces_.half_borders.clear();
  faces_.loop_sizes.clear();
  faces_.closed = true;
  chain_loops(borders, walk);
  faces_.loop_face.assign(faces_.loop_sizes.size(), 0);
  faces_.face_count = walk.empty() && seen_from_inside ? 0 : 1;
  if (faces_.loop_sizes.size() > 1 && faces_.closed) {
    list_arcs(borders, {center, radius, seen_from_inside});
    group_loops();
  }
  return faces_;
}

}  // namespace meniscus
