// SPDX-License-Identifier: BSD-3-Clause
// Sides from which one looks into a molecule or through it, and how much must be cut away for atoms to be seen.
#pragma once

#include <optional>
#include <span>

#include "core/camera/camera.h"
#include "core/math/ball.h"

namespace meniscus {

/// Axes of a picture from that side; the longest extent of `seen` across the view lies horizontally. seen: at least one
/// ball. all: with those of `seen` among them or not. Of directions spread over the sphere the one along which most
/// points on the balls of `seen` are free of the others, or, where several have as many, along which the covered points
/// lie least deep. Points and directions are samples: about 500 of each.
ViewBasis open_side(std::span<const Ball> seen, std::span<const Ball> all);

/// Axes of a picture along a straight channel, from the end that lies nearest to +z; the longest extent of `around`
/// across the view lies horizontally. Of directions spread over the sphere the one along which the largest cylinder
/// goes through what `around` encloses: as wide as none of `all` is in its way, as long as `around` has atoms on all
/// its sides. Of those near it the middle is taken, each weighted by what is seen along it. Nothing where there is no
/// cylinder of 2 Å. around: at least one ball. all: with those of `around` among them. Directions are samples.
std::optional<ViewBasis> channel_end(std::span<const Ball> around, std::span<const Ball> all);

/// Where a plane that faces the viewer has to be.
struct OpenDepth {
  double depth = 0.0;       ///< Å, along the view's forward axis: what is before it is cut away
  double seen = 1.0;        ///< share of what a picture of `seen` alone would show that is seen then
  bool is_limited = false;  ///< by those of `seen` that are among `all`
};

/// The plane nearest to the viewer behind which the others hide at most a twentieth of what a picture of `seen` alone
/// would show. It cuts none of those of `seen` whose centres are among `all`; so it may be nearer, and more be hidden.
/// seen: at least one ball. Rays are samples: about 2000.
OpenDepth open_depth(std::span<const Ball> seen, std::span<const Ball> all, const Camera& camera);

}  // namespace meniscus
