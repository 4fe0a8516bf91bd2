// SPDX-License-Identifier: BSD-3-Clause
// The triangles at each vertex of any mesh, and whether they go around it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace meniscus {

/// Per vertex the corners (3 * triangle + 0..2) there, ascending. The triangles need not be a closed mesh, nor a
/// manifold.
class CornerLists {
 public:
  CornerLists(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t vertex_count);

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(first_.size() - 1); }
  std::span<const std::uint32_t> at(std::uint32_t vertex) const {
    return {corners_.data() + first_[vertex], first_[vertex + 1] - first_[vertex]};
  }

 private:
  std::vector<std::uint32_t> first_;  ///< per vertex, and one more: into corners_
  std::vector<std::uint32_t> corners_;
};

/// Do the triangles at these corners of one vertex go around it once? Not if they are fewer than three.
bool go_around_once(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const std::uint32_t> corners);

}  // namespace meniscus
