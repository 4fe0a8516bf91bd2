// SPDX-License-Identifier: BSD-3-Clause
// Common walks over the tables of a surface: points on its arcs, pieces of a patch, borders of a face.
#pragma once

#include "core/surface/parallel_tables.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Returns the unit vector from the centre of an arc's circle at angle t (radians) from the start, counter-clockwise
/// about the axis. An Arc is a Border, a ToroidalPatch, or any type with `axis` and `start`.
template <typename Arc>
glm::dvec3 arc_direction(const Arc& arc, double t) {
  return std::cos(t) * arc.start + std::sin(t) * glm::cross(arc.axis, arc.start);
}

/// Returns the point of the arc at angle t, Å. For a ToroidalPatch it is the probe's centre.
template <typename Arc>
glm::dvec3 arc_point(const Arc& arc, double t) {
  return arc.center + arc.radius * arc_direction(arc, t);
}

/// Returns the index of the border that a half-border walks.
inline std::uint32_t border_of(HalfBorder half) { return half / 2; }
inline bool is_backwards(HalfBorder half) { return (half & 1) != 0; }

/// Returns the connected pieces of a patch.
template <typename Patch>
std::span<const Face> faces_of(const Surface& surface, const Patch& patch) {
  return {surface.faces.data() + patch.first_face, patch.face_count};
}

inline std::span<const Loop> loops_of(const Surface& surface, const Face& face) {
  return {surface.loops.data() + face.first_loop, face.loop_count};
}

/// Returns the half-borders of a loop in the order of the walk.
inline std::span<const HalfBorder> half_borders_of(const Surface& surface, const Loop& loop) {
  return {surface.half_borders.data() + loop.first_half_border, loop.half_border_count};
}

/// Returns the border of a half-border, or one past the last if `half_border` is past the end of the walks.
inline std::size_t border_at(const Surface& surface, std::size_t half_border) {
  return half_border < surface.half_borders.size() ? border_of(surface.half_borders[half_border])
                                                   : surface.borders.size();
}

/// Prefetches a border that will soon be walked. `half_border` is an index into Surface::half_borders, or past its end.
[[gnu::always_inline]] inline void prefetch_border(const Surface& surface, std::size_t half_border) {
  prefetch(surface.borders, border_at(surface, half_border));
}

/// Calls visit(half border) for every half-border of a face, loop after loop.
template <typename Visit>
void for_each_half_border(const Surface& surface, const Face& face, const Visit& visit) {
  for (const Loop& loop : loops_of(surface, face))
    for (std::size_t n = 0; n < loop.half_border_count; ++n) {
      prefetch_border(surface, loop.first_half_border + n + kPrefetchAhead);
      visit(surface.half_borders[loop.first_half_border + n]);
    }
}

/// Calls visit(border) for every border of a face, loop after loop.
template <typename Visit>
void for_each_border(const Surface& surface, const Face& face, const Visit& visit) {
  for_each_half_border(surface, face, [&](HalfBorder half) { visit(surface.borders[border_of(half)]); });
}

}  // namespace meniscus
