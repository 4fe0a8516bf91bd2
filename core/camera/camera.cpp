// SPDX-License-Identifier: BSD-3-Clause
// Computes the rays and matrices of cameras, frames molecules, and interpolates paths.
#include "core/camera/camera.h"

#include <array>
#include <cassert>
#include <limits>
#include <numbers>

#define GLM_ENABLE_EXPERIMENTAL
#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

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
  // Squares of smaller and larger numbers exceed the range of double precision.
  constexpr double kSmallest = 1e-100, kLargest = 1e100;
  if (!(scale <= kLargest)) fail(fmt::format("position and target must lie within {:g} Å of the origin", kLargest));
  if (glm::length(view) <= 1e-12 * scale || glm::length(view) < kSmallest)
    fail("position and target are the same point, so there is no view direction");
  const double up_length = glm::length(camera.up);
  if (!(up_length >= kSmallest && up_length <= kLargest)) fail("\"up\" has no direction");
  // The sine of their angle; if it is smaller, rounding errors would turn the picture.
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

/// Returns the eigenvectors of a symmetric matrix as columns, largest eigenvalue first (cyclic Jacobi rotations; Jacobi
/// 1846).
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

/// Returns the tangent of half the angle of a perspective camera, less the margin.
double tangent_of(const Camera& camera) { return std::tan(camera.vertical_fov * (std::numbers::pi / 360.0)) / kMargin; }

/// Returns (sideways, depth) of the edge at which two planes that open at `half_angle` about +z touch all balls.
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

/// Returns the lowest and highest coordinate of the balls along a direction.
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
  // Four turns show the same side; this is the one nearest to the usual view along -z with y up.
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

namespace {

/// The interpolated parameters of a camera.
struct Pose {
  glm::dvec3 target;
  glm::dvec3 size;  ///< logarithms of distance, angle, height
  glm::dquat axes;
};

Pose pose_of(const Camera& camera) {
  const ViewBasis basis = view_basis(camera);
  return {
      camera.target,
      {std::log(glm::distance(camera.position, camera.target)), std::log(camera.vertical_fov), std::log(camera.height)},
      glm::quat_cast(glm::dmat3(basis.right, basis.up, -basis.forward))};
}

Camera camera_of(const Pose& pose, Projection projection) {
  Camera camera;
  const glm::dmat3 axes = glm::mat3_cast(glm::normalize(pose.axes));
  camera.projection = projection;
  camera.target = pose.target;
  // Between keys the curves may overshoot, but not to invalid cameras: an angle of 180 degrees, or a distance that
  // vanishes compared with the target.
  constexpr double kWidest = 179.9;
  const double nearest = 1e-9 * glm::length(pose.target);
  camera.position = pose.target + axes[2] * std::clamp(std::exp(pose.size.x), std::max(nearest, 1e-99), 1e99);
  camera.up = axes[1];
  camera.vertical_fov = std::min(std::exp(pose.size.y), kWidest);
  camera.height = std::clamp(std::exp(pose.size.z), 1e-99, 1e99);
  return camera;
}

/// Evaluates a cubic Hermite curve at share s of an interval of length h.
glm::dvec3 hermite(const glm::dvec3& a, const glm::dvec3& slope_a, const glm::dvec3& b, const glm::dvec3& slope_b,
                   double h, double s) {
  const double s2 = s * s, s3 = s2 * s;
  return (2.0 * s3 - 3.0 * s2 + 1.0) * a + (s3 - 2.0 * s2 + s) * h * slope_a + (3.0 * s2 - 2.0 * s3) * b +
         (s3 - s2) * h * slope_b;
}

/// Evaluates the Bézier curve of four rotations (K. Shoemake, Animating rotation with quaternion curves, 1985).
glm::dquat bezier(const glm::dquat& a, const glm::dquat& b, const glm::dquat& c, const glm::dquat& d, double s) {
  const glm::dquat ab = glm::slerp(a, b, s), bc = glm::slerp(b, c, s), cd = glm::slerp(c, d, s);
  return glm::slerp(glm::slerp(ab, bc, s), glm::slerp(bc, cd, s), s);
}

/// Returns q or -q, which is the same rotation: the one nearer to the other quaternion.
glm::dquat with_nearest_sign(const glm::dquat& q, const glm::dquat& other) { return glm::dot(q, other) < 0.0 ? -q : q; }

}  // namespace

CameraPath::CameraPath(std::vector<CameraKey> keys) : keys_(std::move(keys)) { assert(!keys_.empty()); }

Camera CameraPath::at(double frame) const {
  const auto behind = std::ranges::upper_bound(keys_, frame, {}, [](const CameraKey& key) { return key.frame; });
  if (behind == keys_.begin()) return keys_.front().camera;
  if (behind == keys_.end()) return keys_.back().camera;
  const std::size_t j = static_cast<std::size_t>(behind - keys_.begin()), i = j - 1;
  if (frame == keys_[i].frame) return keys_[i].camera;  // exact to the last bit
  const std::size_t before = i == 0 ? i : i - 1, after = std::min(j + 1, keys_.size() - 1);
  Pose pose[4] = {pose_of(keys_[before].camera), pose_of(keys_[i].camera), pose_of(keys_[j].camera),
                  pose_of(keys_[after].camera)};
  for (int n = 1; n < 4; ++n) pose[n].axes = with_nearest_sign(pose[n].axes, pose[n - 1].axes);
  const double h = keys_[j].frame - keys_[i].frame, s = (frame - keys_[i].frame) / h;
  const auto slope = [&](const glm::dvec3 Pose::*part, int from, int to, std::size_t key_from, std::size_t key_to) {
    return (pose[to].*part - pose[from].*part) / (keys_[key_to].frame - keys_[key_from].frame);
  };
  const auto curve = [&](const glm::dvec3 Pose::*part) {
    return hermite(pose[1].*part, slope(part, 0, 2, before, j), pose[2].*part, slope(part, 1, 3, i, after), h, s);
  };
  // The rotation over a third of this interval at the rate at each of its ends.
  const auto third = [&](int from, int to, std::size_t key_from, std::size_t key_to) {
    return glm::pow(glm::inverse(pose[from].axes) * pose[to].axes,
                    h / (3.0 * (keys_[key_to].frame - keys_[key_from].frame)));
  };
  const glm::dquat axes = bezier(pose[1].axes, pose[1].axes * third(0, 2, before, j),
                                 pose[2].axes * glm::inverse(third(1, 3, i, after)), pose[2].axes, s);
  return camera_of({curve(&Pose::target), curve(&Pose::size), axes}, keys_[i].camera.projection);
}

Camera turned(const Camera& camera, const glm::dvec3& pivot, const glm::dvec3& axis, double angle) {
  const glm::dmat3 turn = glm::mat3_cast(glm::angleAxis(angle, axis));
  Camera result = camera;
  result.position = pivot + turn * (camera.position - pivot);
  result.target = pivot + turn * (camera.target - pivot);
  result.up = turn * camera.up;
  return result;
}

Camera shifted(const Camera& camera, const glm::dvec3& shift) {
  Camera result = camera;
  result.position += shift;
  result.target += shift;
  return result;
}

glm::dmat4 world_to_camera(const Camera& camera) {
  const ViewBasis basis = view_basis(camera);
  const auto row = [&](const glm::dvec3& axis) { return glm::dvec4(axis, -glm::dot(axis, camera.position)); };
  return glm::transpose(
      glm::dmat4(row(basis.right), row(basis.up), row(basis.forward), glm::dvec4(0.0, 0.0, 0.0, 1.0)));
}

glm::dmat4 world_to_picture(const Camera& camera, double aspect) {
  const glm::dvec2 half = half_extent(camera, aspect);
  const bool is_perspective = camera.projection == Projection::perspective;
  // The third row only makes the matrix invertible.
  const glm::dvec4 divisor = is_perspective ? glm::dvec4(0, 0, 1, 0) : glm::dvec4(0, 0, 0, 1);
  const glm::dmat4 projection = glm::transpose(glm::dmat4(glm::dvec4(0.5 / half.x, 0, 0, 0) + 0.5 * divisor,
                                                          glm::dvec4(0, -0.5 / half.y, 0, 0) + 0.5 * divisor,
                                                          glm::dvec4(0, 0, 1, is_perspective ? -1 : 0), divisor));
  return projection * world_to_camera(camera);
}

glm::dvec2 place_in_picture(const Camera& camera, const glm::dvec2& size, const glm::dvec3& point) {
  const glm::dvec4 place = world_to_picture(camera, size.x / size.y) * glm::dvec4(point, 1.0);
  return size * glm::dvec2(place) / place.w;
}

}  // namespace meniscus
