// SPDX-License-Identifier: BSD-3-Clause
// Lists the triangles at each vertex of a mesh, and finds out whether they go around it once.
#include "core/mesh/corner_lists.h"

#include <numeric>

#include "core/base/index.h"

namespace meniscus {

CornerLists::CornerLists(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t vertex_count)
    : first_(std::size_t{vertex_count} + 1, 0), corners_(3 * triangles.size()) {
  for (const auto& t : triangles)
    for (const std::uint32_t v : t) ++first_[v];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  auto corner = static_cast<std::uint32_t>(corners_.size());
  for (std::size_t t = triangles.size(); t-- > 0;)
    for (std::size_t k = 3; k-- > 0;) corners_[--first_[triangles[t][k]]] = --corner;
}

bool go_around_once(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const std::uint32_t> corners) {
  if (corners.size() < 3) return false;
  const auto after = [&](std::uint32_t c) { return triangles[c / 3][(c % 3 + 1) % 3]; };
  const auto before = [&](std::uint32_t c) { return triangles[c / 3][(c % 3 + 2) % 3]; };
  std::uint32_t at = corners[0];
  for (std::size_t n = 1;; ++n) {
    std::uint32_t found = kNone;
    for (const std::uint32_t c : corners) {
      if (after(c) != before(at)) continue;
      if (found != kNone) return false;
      found = c;
    }
    if (found == kNone) return false;
    if (found == corners[0]) return n == corners.size();
    if (n == corners.size()) return false;
    at = found;
  }
}

}  // namespace meniscus
