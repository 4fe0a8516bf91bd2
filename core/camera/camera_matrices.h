// SPDX-License-Identifier: BSD-3-Clause
// A camera as matrices: from the world to its own space, and to positions in its picture.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

struct Camera;

/// Returns the transform from the world, Å, to x right, y up and z along the view from the camera's position, Å:
/// left-handed, as in OpenEXR. It is for column vectors; in memory, column after column, it is the matrix that OpenEXR
/// stores for row vectors.
glm::dmat4 world_to_camera(const Camera& camera);

/// Returns the transform from the world to the picture, after the division by w: x to the right and y down, (0, 0) in
/// its upper left corner and (1, 1) in its lower right corner. aspect: width / height.
glm::dmat4 world_to_picture(const Camera& camera, double aspect);

/// Returns the position of a point in a picture of `size` pixels, from its upper left corner. The point must lie in
/// front of the camera.
glm::dvec2 place_in_picture(const Camera& camera, const glm::dvec2& size, const glm::dvec3& point);

}  // namespace meniscus
