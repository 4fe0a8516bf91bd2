// SPDX-License-Identifier: BSD-3-Clause
// How commands turn and place a camera: pure functions.
#pragma once

#include <span>

#include <glm/vec2.hpp>

#include "core/camera/camera.h"

namespace meniscus {

/// Å between the lower and upper edge of the picture, in the plane through the target.
double height_at_target(const Camera& camera);

/// Turns about the target as a trackball: the front follows the cursor. drag: in heights of the picture, to the right
/// and down; a drag over the whole height turns the molecule half around. The distance from the target stays.
Camera orbited(const Camera& camera, glm::dvec2 drag);

/// The same view by another projection: what lies in the plane of the target keeps its size. An orthographic camera
/// is outside of all `balls`, whichever way it turns, since it sees nothing behind its plane.
Camera projected(const Camera& camera, Projection projection, std::span<const Ball> balls);

/// Looks the same way at all of `shown`, with a small margin, from outside of all `balls` if orthographic. There must
/// be a ball in each. aspect: width / height of the picture.
Camera zoomed_to(const Camera& camera, std::span<const Ball> shown, std::span<const Ball> balls, double aspect);

/// The default view of all of the balls (frame_camera), which may be turned any way. There must be a ball.
Camera overview(std::span<const Ball> balls, double aspect, Projection projection);

}  // namespace meniscus
