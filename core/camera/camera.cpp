// SPDX-License-Identifier: BSD-3-Clause
// Computes the axes and rays of a camera, and places one so that it shows all balls.
#include "core/camera/camera.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "core/base/error.h"
#include "core/math/ball.h"

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

namespace {

constexpr double kMargin = 1.06;  // share of the picture's edge length to the surface's

/// Eigenvectors of a symmetric matrix as columns, largest eigenvalue first (cyclic Jacobi rotations; Jacobi 1846).
glm::dmat3 principal_axes(glm::dmat3 a) {
  glm::dmat3 axes(1.0);
  for (int sweep = 0; sweep < 32; ++sweep) {
    for (const auto& [p, q] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
      if (a[q][p] == 0.0) continue;
      const double theta = (a[q][q] - a[p][p]) / (2.0 * a[q][p]);
      const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
      const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
      glm::dmat3 rotation(1.0);
      rotation[p][p] = rotation[q][q] = c;
      rotation[q][p] = s;
      rotation[p][q] = -s;
      a = glm::transpose(rotation) * a * rotation;
      a[q][p] = a[p][q] = 0.0;
      axes = axes * rotation;
    }
  }
  std::array<int, 3> order{0, 1, 2};
  std::ranges::stable_sort(order, [&](int i, int j) { return a[i][i] > a[j][j]; });
  return {axes[order[0]], axes[order[1]], axes[order[2]]};
}

/// Of half the angle of a perspective camera, with the margin taken off.
double tangent_of(const Camera& camera) { return std::tan(camera.vertical_fov * (std::numbers::pi / 360.0)) / kMargin; }

/// Where two planes that open at `half_angle` about +z touch all balls from outside: (sideways, depth) of their edge.
glm::dvec2 touch(std::span<const Ball> balls, const glm::dvec3& sideways, const glm::dvec3& forward, double tangent) {
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent), sine = tangent * cosine;
  double left = std::numeric_limits<double>::max(), right = left;
  for (const Ball& ball : balls) {
    const double x = glm::dot(ball.center, sideways) * cosine, z = glm::dot(ball.center, forward) * sine;
    left = std::min(left, z + x - ball.radius);
    right = std::min(right, z - x - ball.radius);
  }
  return {(left - right) / (2.0 * cosine), (left + right) / (2.0 * sine)};
}

/// Lowest and highest coordinate of the balls along a direction.
glm::dvec2 range_along(std::span<const Ball> balls, const glm::dvec3& direction) {
  glm::dvec2 range(std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest());
  for (const Ball& ball : balls) {
    const double x = glm::dot(ball.center, direction);
    range = {std::min(range.x, x - ball.radius), std::max(range.y, x + ball.radius)};
  }
  return range;
}

}  // namespace

ViewBasis broad_side(std::span<const Ball> balls) {
  glm::dvec3 mean(0.0);
  for (const Ball& ball : balls) mean += ball.center;
  mean /= static_cast<double>(balls.size());
  glm::dmat3 covariance(0.0);
  for (const Ball& ball : balls) covariance += glm::outerProduct(ball.center - mean, ball.center - mean);
  const glm::dmat3 axes = principal_axes(covariance);
  // Of the four turns that show the same side, the one nearest to the usual view along -z with y up.
  const glm::dvec3 forward = axes[2].z > 0.0 ? -axes[2] : axes[2];
  const glm::dvec3 up = axes[1].y < 0.0 ? -axes[1] : axes[1];
  return {glm::cross(forward, up), up, forward};
}

Camera frame_camera(std::span<const Ball> balls, double aspect, Projection projection) {
  assert(!balls.empty());
  Camera lens;
  lens.projection = projection;
  return frame_camera(balls, broad_side(balls), aspect, lens);
}

Camera frame_camera(std::span<const Ball> balls, const ViewBasis& basis, double aspect, const Camera& lens) {
  assert(!balls.empty() && aspect > 0.0);
  const glm::dvec2 depth = range_along(balls, basis.forward);
  Camera camera = lens;
  camera.up = basis.up;
  glm::dvec2 side;
  double eye_depth = 0.0;
  if (camera.projection == Projection::perspective) {
    const double tangent = tangent_of(camera);
    const glm::dvec2 x = touch(balls, basis.right, basis.forward, tangent * aspect);
    const glm::dvec2 y = touch(balls, basis.up, basis.forward, tangent);
    side = {x.x, y.x};
    eye_depth = std::min(x.y, y.y);
  } else {
    const glm::dvec2 x = range_along(balls, basis.right), y = range_along(balls, basis.up);
    side = {0.5 * (x.x + x.y), 0.5 * (y.x + y.y)};
    camera.height = kMargin * std::max(y.y - y.x, (x.y - x.x) / aspect);
    eye_depth = depth.x - 0.1 * (depth.y - depth.x);
  }
  const glm::dvec3 axis_point = basis.right * side.x + basis.up * side.y;
  camera.position = axis_point + basis.forward * eye_depth;
  camera.target = axis_point + basis.forward * (0.5 * (depth.x + depth.y));
  return camera;
}

DecisiveBalls::DecisiveBalls(const ViewBasis& basis, double aspect, const Camera& lens)
    : basis_(basis), aspect_(aspect), lens_(lens) {
  const double tangent = tangent_of(lens_);
  for (const auto& [sideways, opening] : {std::pair{basis.right, tangent * aspect}, {basis.up, tangent}}) {
    const double cosine = 1.0 / std::sqrt(1.0 + opening * opening), sine = opening * cosine;
    for (const double side : {-1.0, 1.0}) {
      directions_.push_back(side * cosine * sideways - sine * basis.forward);  // the two planes of touch()
      directions_.push_back(side * sideways);
    }
  }
  directions_.push_back(basis.forward);
  directions_.push_back(-basis.forward);
}

void DecisiveBalls::add(std::span<const Ball> balls) {
  if (balls.empty()) return;
  if (farthest_.empty()) farthest_.assign(directions_.size(), balls.front());
  for (std::size_t n = 0; n < directions_.size(); ++n) {
    const auto reach = [&](const Ball& ball) { return glm::dot(ball.center, directions_[n]) + ball.radius; };
    double farthest = reach(farthest_[n]);
    for (const Ball& ball : balls) {
      if (reach(ball) <= farthest) continue;
      farthest = reach(ball);
      farthest_[n] = ball;
    }
  }
}

Camera DecisiveBalls::frame() const { return frame_camera(farthest_, basis_, aspect_, lens_); }

}  // namespace meniscus
