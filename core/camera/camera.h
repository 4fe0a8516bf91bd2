// SPDX-License-Identifier: BSD-3-Clause
// The camera that ray caster and exporters share: its rays, a default one for a surface, and its path between keys.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

struct Ball;

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

/// Throws InputError naming `file` when the camera shows nothing sensible.
void validate_camera(const Camera& camera, const std::string& file);

/// Axes of a valid camera.
ViewBasis view_basis(const Camera& camera);

/// Half the picture's width and height on the plane one Å in front of a perspective camera, or in Å if orthographic.
glm::dvec2 half_extent(const Camera& camera, double aspect);

/// The ray through `pixel` (column, row from the top; (0.5, 0.5) is the centre of the first pixel) of a picture of
/// `size` pixels. A perspective ray starts at the position, an orthographic one on the plane through it.
Ray pixel_ray(const Camera& camera, glm::dvec2 size, glm::dvec2 pixel);

/// A camera that shows all of the balls with a small margin, their widest side across the picture (principal axes of
/// the centres), from the side nearest to +z. aspect: width / height of the picture. There must be a ball.
Camera frame_camera(std::span<const Ball> balls, double aspect, Projection projection = Projection::perspective);
/// The same, seen along the axes given. lens: its projection and, with perspective, its angle are taken.
Camera frame_camera(std::span<const Ball> balls, const ViewBasis& basis, double aspect, const Camera& lens);

/// The axes along which frame_camera looks by default. There must be a ball.
ViewBasis broad_side(std::span<const Ball> balls);

/// Of any number of balls the few on which frame_camera with these axes depends: so it can frame all the moments of a
/// trajectory without keeping them.
class DecisiveBalls {
 public:
  DecisiveBalls(const ViewBasis& basis, double aspect, const Camera& lens);
  void add(std::span<const Ball> balls);
  /// What frame_camera makes of all the balls that were added. There must be one.
  Camera frame() const;

 private:
  ViewBasis basis_;
  double aspect_;
  Camera lens_;
  std::vector<glm::dvec3> directions_;
  std::vector<Ball> farthest_;  ///< along each direction, by its outer side; empty before the first
};

/// A camera at a moment.
struct CameraKey {
  double frame = 0.0;
  Camera camera;
};

/// Goes through its keys smoothly: the target and the logarithms of distance, angle and height along cubic Hermite
/// curves with the slopes of Catmull and Rom (1974) for uneven steps, the axes of the view along the spherical
/// quadrangles of Shoemake (1987). Still before the first key and after the last.
class CameraPath {
 public:
  /// keys: at least one, frames rising, all of one projection.
  explicit CameraPath(std::vector<CameraKey> keys);
  Camera at(double frame) const;

 private:
  std::vector<CameraKey> keys_;
};

/// The camera carried around the line through `pivot` along `axis` (of length 1) by `angle` (radians, right-handed).
Camera turned(const Camera& camera, const glm::dvec3& pivot, const glm::dvec3& axis, double angle);
/// The camera carried along.
Camera shifted(const Camera& camera, const glm::dvec3& shift);

}  // namespace meniscus
