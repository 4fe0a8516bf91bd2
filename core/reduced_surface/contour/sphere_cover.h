// SPDX-License-Identifier: BSD-3-Clause
// Decides quickly and safely whether a part of a SAS sphere is covered: most atoms and circles are, and need no more
// work.
//
// A sphere is sampled in 162 directions, so dense that every point lies within a known angle of one. A direction counts
// as covered when one ball covers everything within that angle of it, with an allowance for rounding; so "covered" is
// certain, and "not covered" only means that a precise test is needed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/reduced_surface/contour/blockers.h"

namespace meniscus {

/// The part of a first ball's sphere that other balls surely cover. Reused from sphere to sphere to save allocations.
class SphereCover {
 public:
  /// Tests the sphere of the blockers' first ball. False if all of it is surely covered: then nothing else is known.
  bool test(const Blockers& blockers);

  /// False if no point of the circle of the sphere and the n-th blocker lies near an uncovered direction: then all of
  /// the circle is covered. Valid after test() returned true.
  bool circle_may_be_exposed(std::size_t n) const { return signs_[n] >= 0; }

  /// Returns the numbers of the directions that are not surely covered. Valid after test() returned true.
  std::span<const std::uint8_t> uncovered() const { return {uncovered_numbers_.data(), uncovered_count_}; }

  /// True if a point of the sphere, given as a unit vector from its centre, is near one of these directions. All other
  /// points are surely covered. Only balls whose circles may be exposed cover points near the directions: the cap of
  /// any other ball neither contains such a direction nor comes as near to it. So if only these balls are applied to a
  /// circle, each remaining arc is exposed as a whole if its middle is near, and covered as a whole if not.
  static bool is_near(const glm::dvec3& point, std::span<const std::uint8_t> uncovered);

 private:
  // Columns of numbers of circles, caps, or directions, padded to whole vectors with undefined values.
  template <std::size_t kColumns>
  struct Rows {
    std::array<std::vector<float>, kColumns> columns;
    float* column(std::size_t c) { return columns[c].data(); }
    void make_room(std::size_t count);
    void repeat_last(std::size_t count, std::size_t past);
  };

  void list_caps(std::size_t count);
  void list_uncovered(const float* x, const float* y, const float* z, std::size_t count);

  Rows<6> circles_;  // per blocker: axis, cosine of its cap, limits of dot products with the axis for directions near
                     // its circle
  Rows<4> caps_;     // per cap: axis, cosine
  Rows<3> uncovered_;
  std::size_t cap_count_ = 0, wide_count_ = 0;  // numbers of caps, in whole steps
  std::size_t uncovered_count_ = 0;
  std::vector<std::int32_t> signs_;
  std::vector<std::uint32_t> listed_;  // scratch: numbers of circles or directions
  std::vector<std::uint8_t> uncovered_numbers_;
};

}  // namespace meniscus
