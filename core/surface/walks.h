// SPDX-License-Identifier: BSD-3-Clause
// Common walks over the tables of a surface: points on its arcs, pieces of a patch, borders of a face.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus {

/// Of a Border, a ToroidalPatch, or whatever has `axis` and `start`: the unit vector from its circle's centre at angle
/// t (radian) from the start, counter-clockwise about the axis.
template <typename Arc>
glm::dvec3 arc_direction(const Arc& arc, double t) {
  return std::cos(t) * arc.start + std::sin(t) * glm::cross(arc.axis, arc.start);
}

/// The point there, Å; of a ToroidalPatch: where the probe's centre is.
template <typename Arc>
glm::dvec3 arc_point(const Arc& arc, double t) {
  return arc.center + arc.radius * arc_direction(arc, t);
}

/// Index of the border that is walked.
inline std::uint32_t border_of(HalfBorder half) { return half / 2; }
inline bool is_backwards(HalfBorder half) { return (half & 1) != 0; }

/// The pieces of a patch.
template <typename Patch>
std::span<const Face> faces_of(const Surface& surface, const Patch& patch) {
  return {surface.faces.data() + patch.first_face, patch.face_count};
}

inline std::span<const Loop> loops_of(const Surface& surface, const Face& face) {
  return {surface.loops.data() + face.first_loop, face.loop_count};
}

/// In the order in which they are walked.
inline std::span<const HalfBorder> half_borders_of(const Surface& surface, const Loop& loop) {
  return {surface.half_borders.data() + loop.first_half_border, loop.half_border_count};
}

/// Asks the memory for a border that will soon be walked: neighbours around a face lie far apart in the table of
/// borders. `half_border` is an index into Surface::half_borders, or past its end.
inline void prefetch_border(const Surface& surface, std::size_t half_border) {
  if (half_border >= surface.half_borders.size()) return;
  const auto* border = reinterpret_cast<const char*>(&surface.borders[border_of(surface.half_borders[half_border])]);
  __builtin_prefetch(border);
  __builtin_prefetch(border + sizeof(Border) - 1);
}

/// How many half-borders ahead that is worth its while.
inline constexpr std::size_t kPrefetchAhead = 12;

/// Calls visit(half border) loop after loop.
template <typename Visit>
void for_each_half_border(const Surface& surface, const Face& face, const Visit& visit) {
  for (const Loop& loop : loops_of(surface, face))
    for (std::size_t n = 0; n < loop.half_border_count; ++n) {
      prefetch_border(surface, loop.first_half_border + n + kPrefetchAhead);
      visit(surface.half_borders[loop.first_half_border + n]);
    }
}

/// Calls visit(border) loop after loop.
template <typename Visit>
void for_each_border(const Surface& surface, const Face& face, const Visit& visit) {
  for_each_half_border(surface, face, [&](HalfBorder half) { visit(surface.borders[border_of(half)]); });
}

}  // namespace meniscus
