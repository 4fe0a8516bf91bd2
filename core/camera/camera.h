// SPDX-License-Identifier: BSD-3-Clause
// The camera that ray caster and exporters share: its rays, its matrices, a default, and a path between keys.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

struct Ball;

/// Perspective: rays meet in the camera's position. Orthographic: rays are parallel.
enum class Projection { perspective, orthographic };

/// A right-handed camera; lengths in Å. `up` need not be perpendicular to the view direction, only not parallel to it.
struct Camera {
  glm::dvec3 position{0.0, 0.0, 1.0};
  glm::dvec3 target{0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  Projection projection = Projection::perspective;
  double vertical_fov = 30.0;  ///< degrees between the picture's lower and upper edge; perspective only
  double height = 1.0;         ///< Å between the lower and upper edge; orthographic only
};

/// Orthonormal axes of the picture: right x up = -forward.
struct ViewBasis {
  glm::dvec3 right, up, forward;
};

/// Points origin + t * direction, t >= 0, |direction| = 1.
struct Ray {
  glm::dvec3 origin, direction;
};

/// Throws InputError naming `file` if the camera is not valid.
void validate_camera(const Camera& camera, const std::string& file);

/// Returns the axes of a valid camera.
ViewBasis view_basis(const Camera& camera);

/// Returns half the picture's width and height: one Å in front of a perspective camera, or in Å if orthographic.
glm::dvec2 half_extent(const Camera& camera, double aspect);

/// Returns the ray through `pixel` (column, row from the top; (0.5, 0.5) is the centre of the first pixel) of a picture
/// of `size` pixels. A perspective ray starts at the position, an orthographic one on the plane through it.
Ray pixel_ray(const Camera& camera, glm::dvec2 size, glm::dvec2 pixel);

/// Returns a camera that shows all of the balls with a small margin, their widest side across the picture (principal
/// axes of the centres), from the side nearest to +z. aspect: width / height of the picture. There must be a ball.
Camera frame_camera(std::span<const Ball> balls, double aspect, Projection projection = Projection::perspective);
/// Returns such a camera along the given axes. lens: provides the projection and, with perspective, the angle.
Camera frame_camera(std::span<const Ball> balls, const ViewBasis& basis, double aspect, const Camera& lens);

/// Returns the axes along which frame_camera looks by default. There must be a ball.
ViewBasis broad_side(std::span<const Ball> balls);

/// Keeps, of any number of balls, the few that determine frame_camera with these axes, so that all frames of a
/// trajectory can be framed without keeping them.
class DecisiveBalls {
 public:
  DecisiveBalls(const ViewBasis& basis, double aspect, const Camera& lens);
  void add(std::span<const Ball> balls);
  /// Returns the camera that frame_camera would return for all balls that were added. There must be one.
  Camera frame() const;

 private:
  ViewBasis basis_;
  double aspect_;
  Camera lens_;
  std::vector<glm::dvec3> directions_;
  std::vector<Ball>
      farthest_;  ///< the farthest ball along each direction, by its outer side; empty before the first ball
};

struct CameraKey {
  double frame = 0.0;
  Camera camera;
};

/// A smooth path through keys: the target and the logarithms of distance, angle and height follow cubic Hermite curves
/// with the slopes of Catmull and Rom (1974) for uneven steps, the axes of the view follow the spherical quadrangles of
/// Shoemake (1987). The camera stays at the first key before it and at the last key after it.
class CameraPath {
 public:
  /// keys: at least one, with ascending frames, all of one projection.
  explicit CameraPath(std::vector<CameraKey> keys);
  Camera at(double frame) const;

 private:
  std::vector<CameraKey> keys_;
};

/// Returns the camera rotated about the line through `pivot` along `axis` (of length 1) by `angle` (radians,
/// right-handed).
Camera turned(const Camera& camera, const glm::dvec3& pivot, const glm::dvec3& axis, double angle);
/// Returns the camera translated by `shift`, Å.
Camera shifted(const Camera& camera, const glm::dvec3& shift);

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
