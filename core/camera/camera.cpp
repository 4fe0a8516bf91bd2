// SPDX-License-Identifier: BSD-3-Clause
// Which cameras are possible, picture axes and pixel rays.
#include "core/camera/camera.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"

namespace meniscus {
namespace {

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

void validate_camera(const Camera& camera, const std::string& file) {
  const auto fail = [&](const std::string& what) { throw InputError(file, 0, "camera: " + what); };
  if (!is_finite(camera.position) || !is_finite(camera.target) || !is_finite(camera.up)) fail("a number is not finite");
  const glm::dvec3 view = camera.target - camera.position;
  const double scale = std::max(glm::length(camera.position), glm::length(camera.target));
  // Squares of smaller and larger numbers have no place in double precision.
  constexpr double kSmallest = 1e-100, kLargest = 1e100;
  if (!(scale <= kLargest)) fail(fmt::format("position and target must lie within {:g} Å of the origin", kLargest));
  if (glm::length(view) <= 1e-12 * scale || glm::length(view) < kSmallest)
    fail("position and target are the same point, so there is no view direction");
  const double up_length = glm::length(camera.up);
  if (!(up_length >= kSmallest && up_length <= kLargest)) fail("\"up\" has no direction");
  // The sine of their angle; below this the picture would turn with rounding errors.
  if (glm::length(glm::cross(view / glm::length(view), camera.up / up_length)) < 1e-9)
    fail("\"up\" is parallel to the view direction");
  if (camera.projection == Projection::perspective) {
    if (!(camera.vertical_fov > 0.0 && camera.vertical_fov < 180.0))
      fail(fmt::format("\"vertical_fov\" is {} degrees; it must lie between 0 and 180", camera.vertical_fov));
  } else if (!(camera.height >= kSmallest && camera.height <= kLargest)) {
    fail(fmt::format("\"height\" is {} Å; it must be positive", camera.height));
  }
}

ViewBasis view_basis(const Camera& camera) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up / glm::length(camera.up)));
  return {right, glm::cross(right, forward), forward};
}

glm::dvec2 half_extent(const Camera& camera, double aspect) {
  const double half_height = camera.projection == Projection::perspective
                                 ? std::tan(camera.vertical_fov * (std::numbers::pi / 360.0))
                                 : 0.5 * camera.height;
  return {half_height * aspect, half_height};
}

Ray pixel_ray(const Camera& camera, glm::dvec2 size, glm::dvec2 pixel) {
  const ViewBasis basis = view_basis(camera);
  const glm::dvec2 half = half_extent(camera, size.x / size.y);
  const glm::dvec3 offset =
      basis.right * (half.x * (2.0 * pixel.x / size.x - 1.0)) + basis.up * (half.y * (1.0 - 2.0 * pixel.y / size.y));
  if (camera.projection == Projection::orthographic) return {camera.position + offset, basis.forward};
  return {camera.position, glm::normalize(basis.forward + offset)};
}

}  // namespace meniscus
