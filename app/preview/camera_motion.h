// SPDX-License-Identifier: BSD-3-Clause
// How mouse and keys move a camera about its target: pure functions, shared by the page and recorded sessions.
#pragma once

#include <numbers>
#include <span>

#include <glm/vec2.hpp>

#include "core/camera/camera.h"

namespace meniscus {

/// A drag from edge to edge, over the height of the picture, turns by this angle (radian): the molecule half around.
inline constexpr double kTurnPerHeight = std::numbers::pi;

/// Distances from the target, and heights of a picture, that motions keep to; Å.
inline constexpr double kSmallestReach = 1e-2;
inline constexpr double kLargestReach = 1e6;

/// Å between the lower and upper edge of the picture, in the plane through the target.
double height_at_target(const Camera& camera);

/// Turns about the target as a trackball: the front follows the cursor. drag: in heights of the picture, to the right
/// and down. The distance from the target stays, and what the target is on.
Camera orbited(const Camera& camera, glm::dvec2 drag);

/// Moves camera and target in the picture plane, so that what lies in the plane of the target follows the cursor.
/// drag: in heights of the picture, to the right and down.
Camera panned(const Camera& camera, glm::dvec2 drag);

/// factor > 1: larger. What lies in the plane of the target becomes `factor` times as large; nearer with perspective,
/// a lower picture without. Stops at kSmallestReach and kLargestReach.
Camera zoomed(const Camera& camera, double factor);

/// The same about a place of the picture: what is there, in the plane of the target, stays. place: from the middle, in
/// heights of the picture, to the right and down.
Camera zoomed_at(const Camera& camera, double factor, glm::dvec2 place);

/// Looks the same way at this point, from as far; from outside of all `balls` if orthographic. There must be one.
Camera centered(const Camera& camera, const glm::dvec3& point, std::span<const Ball> balls);

/// Turns the picture clockwise by an angle in radian.
Camera rolled(const Camera& camera, double angle);

/// The same view by another projection: what lies in the plane of the target keeps its size. An orthographic camera
/// is outside of all `balls`, whichever way it turns, since it sees nothing behind its plane.
Camera projected(const Camera& camera, Projection projection, std::span<const Ball> balls);

/// Looks the same way at all of `shown`, with a small margin, from outside of all `balls` if orthographic. There must
/// be a ball in each. aspect: width / height of the picture.
Camera zoomed_to(const Camera& camera, std::span<const Ball> shown, std::span<const Ball> balls, double aspect);

/// The default view of all of the balls (frame_camera), which may be turned any way. There must be a ball.
Camera overview(std::span<const Ball> balls, double aspect, Projection projection);

}  // namespace meniscus
