// SPDX-License-Identifier: BSD-3-Clause
// Decides quickly and safely whether a part of a SAS sphere is covered: most atoms and circles are, and need no more
// work.
//
// A sphere is sampled in 252 directions, so dense that every point lies within a known angle of one. A direction counts
// as covered when one ball covers everything within that angle of it, with an allowance for rounding; so "covered" is
// certain, and "not covered" only means that a precise test is needed.
#pragma once

#include <array>

#include "core/reduced_surface/contour/blockers.h"

namespace meniscus {

/// The part of a first ball's sphere that other balls surely cover. Reused from sphere to sphere to save allocations.
class SphereCover {
 public:
  static constexpr std::size_t kPadded = 256;  ///< the number of directions, in whole blocks

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
  static constexpr std::size_t kCapColumns = 5;

  void list_caps(const std::int16_t* limit, std::size_t count);
  void list_uncovered(const std::int16_t* x, const std::int16_t* y, const std::int16_t* z, std::size_t count,
                      std::uint32_t* list);

  std::vector<std::int32_t> products_;  // per blocker: axis and limits of products with it (Caps), column by column
  std::vector<std::int16_t> circles_;   // the same in 16 bits
  std::vector<std::uint32_t> caps_;     // the blockers whose caps cover something, the wide ones first
  std::size_t cap_count_ = 0, wide_count_ = 0;  // numbers of caps, in whole steps
  std::array<std::array<std::int16_t, kPadded>, 3> uncovered_{};
  std::array<std::uint8_t, kPadded> uncovered_numbers_{};
  std::size_t uncovered_count_ = 0;
  std::vector<std::int16_t> signs_;
  // Scratch: the directions outside the wide caps, and the places in this list of those outside all caps.
  std::array<std::uint32_t, kPadded + kLanes> outside_wide_{}, outside_all_{};
};

}  // namespace meniscus
