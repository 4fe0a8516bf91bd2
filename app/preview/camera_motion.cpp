// SPDX-License-Identifier: BSD-3-Clause
// Turns a camera in such a way that its distance does not drift, however often it is turned.
#include "app/preview/preview_state.h"

#include <numbers>

#include "core/math/ball.h"

namespace meniscus {
namespace {

double distance_of(const Camera& camera) { return glm::length(camera.position - camera.target); }

/// Å of height in the target's plane for each Å of distance.
double height_per_distance(const Camera& camera) {
  return 2.0 * std::tan(camera.vertical_fov * (std::numbers::pi / 360.0));
}

/// v turned about the unit vector `axis` (Rodrigues 1840).
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1.0 - c));
}

/// Moves an orthographic camera back, so that no ball comes before its plane however it turns about its target.
Camera outside(Camera camera, std::span<const Ball> balls) {
  if (camera.projection == Projection::perspective) return camera;
  double reach = 0.0;
  for (const Ball& ball : balls) reach = std::max(reach, glm::length(ball.center - camera.target) + ball.radius);
  const glm::dvec3 forward = view_basis(camera).forward;
  camera.position = camera.target - forward * std::max(2.0 * reach, 1e-2);
  return camera;
}

}  // namespace

double height_at_target(const Camera& camera) {
  return camera.projection == Projection::orthographic ? camera.height
                                                       : height_per_distance(camera) * distance_of(camera);
}

Camera orbited(const Camera& camera, glm::dvec2 drag) {
  const double length = std::hypot(drag.x, drag.y);
  const ViewBasis basis = view_basis(camera);
  if (length == 0.0) return camera;
  const glm::dvec3 axis = glm::normalize(basis.up * (-drag.x / length) + basis.right * (-drag.y / length));
  const double angle = length * std::numbers::pi;
  Camera moved = camera;
  moved.position = camera.target - glm::normalize(turned(basis.forward, axis, angle)) * distance_of(camera);
  moved.up = glm::normalize(turned(basis.up, axis, angle));
  return moved;
}

Camera projected(const Camera& camera, Projection projection, std::span<const Ball> balls) {
  if (projection == camera.projection) return camera;
  Camera other = camera;
  other.projection = projection;
  if (projection == Projection::orthographic) {
    other.height = height_at_target(camera);
    return outside(other, balls);
  }
  other.position = camera.target - view_basis(camera).forward * (camera.height / height_per_distance(camera));
  return other;
}

Camera zoomed_to(const Camera& camera, std::span<const Ball> shown, std::span<const Ball> balls, double aspect) {
  return outside(frame_camera(shown, view_basis(camera), aspect, camera), balls);
}

Camera overview(std::span<const Ball> balls, double aspect, Projection projection) {
  return outside(frame_camera(balls, aspect, projection), balls);
}

}  // namespace meniscus
