// SPDX-License-Identifier: BSD-3-Clause
// Finds sides that look into a molecule or through it, and the depth of a cut that exposes atoms.
#pragma once

#include <optional>

#include "core/camera/camera.h"
#include "core/math/ball.h"

namespace meniscus {

/// Returns the axes of a picture with the best view of `seen`; the longest extent of `seen` across the view lies
/// horizontally. Among directions spread over the sphere it chooses the one along which most points on the balls of
/// `seen` are free of the others; of several, the one along which the covered points lie least deep. Points and
/// directions are samples: about 500 of each. seen: at least one ball. all: with or without the balls of `seen`.
ViewBasis open_side(std::span<const Ball> seen, std::span<const Ball> all);

/// Returns the axes of a picture along a straight channel, from the end nearest to +z; the longest extent of `around`
/// across the view lies horizontally. Among directions spread over the sphere it chooses the one with the largest
/// cylinder through the inside of `around`: no ball of `all` enters the cylinder, and it is as long as `around` has
/// atoms on all its sides. The result is the mean of nearby directions, weighted by the visible area along each.
/// Nothing if there is no cylinder of 2 Å. around: at least one ball. all: includes the balls of `around`. Directions
/// are samples.
std::optional<ViewBasis> channel_end(std::span<const Ball> around, std::span<const Ball> all);

/// The number of groups that shows_more_behind() can tell apart. Balls of this group hide others, but do not count.
inline constexpr std::uint32_t kCountedGroups = 64;

/// True if the opposite side of a view shows clearly more of several groups of balls, such as chains and ligands: the
/// sum of the square roots of their visible areas is greater there, by 3 % of the sum for groups that none other hides.
/// Areas are counted in a picture of 160 pixels across. group: per ball, 0 to kCountedGroups.
bool shows_more_behind(const ViewBasis& view, std::span<const Ball> balls, std::span<const std::uint32_t> group);

/// The position of a plane that faces the viewer.
struct OpenDepth {
  double depth = 0.0;       ///< Å, along the view's forward axis: everything in front of it is cut away
  double seen = 1.0;        ///< the visible share of a picture of `seen` alone
  bool is_limited = false;  ///< true if balls of `seen` that are among `all` limit the depth
};

/// Returns the plane nearest to the viewer behind which the other balls hide at most a twentieth of a picture of `seen`
/// alone. It cuts no ball of `seen` with its centre among `all`; so it may be nearer, and more may be hidden. Rays are
/// samples: about 2000. seen: at least one ball.
OpenDepth open_depth(std::span<const Ball> seen, std::span<const Ball> all, const Camera& camera);

}  // namespace meniscus
