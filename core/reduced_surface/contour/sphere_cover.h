// SPDX-License-Identifier: BSD-3-Clause
// A quick, safe answer to "is this part of a SAS sphere covered?": most atoms and circles are, and need no more work.
//
// A sphere is watched in 162 directions so dense that every point lies within a known angle of one. A direction counts
// as covered when one ball covers everything within that angle of it, with room for rounding; so "covered" is certain
// and "not covered" only means that someone has to look closer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/reduced_surface/contour/blockers.h"

namespace meniscus {

/// What the balls around a first one surely cover of its sphere. Reused from sphere to sphere to save allocations.
class SphereCover {
 public:
  /// Looks at the sphere of the blockers' first ball. False if all of it is surely covered: nothing else is known then.
  bool look(const Blockers& blockers);

  /// After look() was true: false if no point of the circle of the sphere and the n-th blocker lies near an uncovered
  /// direction: then all of the circle is covered.
  bool circle_may_be_exposed(std::size_t n) const { return signs_[n] >= 0; }

  /// After look() was true: the numbers of the directions that are not surely covered.
  std::span<const std::uint8_t> uncovered() const { return {uncovered_numbers_.data(), uncovered_count_}; }

  /// Whether a point of the sphere, a unit vector from its centre, is near one of these directions. All points that are
  /// not are surely covered. What is near them is covered by those alone whose circles may be exposed: the cap of any
  /// other neither holds such a direction nor comes as near to it. So of what those alone leave of a circle, each arc
  /// is exposed as a whole if its middle is near, and covered as a whole if not.
  static bool is_near(const glm::dvec3& point, std::span<const std::uint8_t> uncovered);

 private:
  // Columns of numbers of circles, caps, or directions; up to whole vectors anything may be behind them.
  template <std::size_t kColumns>
  struct Rows {
    std::array<std::vector<float>, kColumns> columns;
    float* column(std::size_t c) { return columns[c].data(); }
    void make_room(std::size_t count);
    void repeat_last(std::size_t count, std::size_t past);
  };

  void list_caps(std::size_t count);
  void list_uncovered(const float* x, const float* y, const float* z, std::size_t count);

  Rows<6> circles_;  // per blocker: axis, cosine of its cap, dot products with the axis of directions near its circle
  Rows<4> caps_;     // axis, cosine
  Rows<3> uncovered_;
  std::size_t cap_count_ = 0, wide_count_ = 0;  // of caps: whole steps
  std::size_t uncovered_count_ = 0;
  std::vector<std::int32_t> signs_;
  std::vector<std::uint32_t> listed_;  // scratch: numbers of circles or directions
  std::vector<std::uint8_t> uncovered_numbers_;
};

}  // namespace meniscus
