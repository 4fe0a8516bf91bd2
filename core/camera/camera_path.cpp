// SPDX-License-Identifier: BSD-3-Clause
// Interpolates a camera between its key frames.
#include "core/camera/camera_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>

namespace meniscus {
namespace {

/// What is interpolated of a camera.
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
  // Between keys the curves may go beyond them, but not to where there is no camera: an angle of 180 degrees, or a
  // distance that vanishes beside the target.
  constexpr double kWidest = 179.9;
  const double nearest = 1e-9 * glm::length(pose.target);
  camera.position = pose.target + axes[2] * std::clamp(std::exp(pose.size.x), std::max(nearest, 1e-99), 1e99);
  camera.up = axes[1];
  camera.vertical_fov = std::min(std::exp(pose.size.y), kWidest);
  camera.height = std::clamp(std::exp(pose.size.z), 1e-99, 1e99);
  return camera;
}

/// Cubic Hermite curve at share s of an interval of length h.
glm::dvec3 hermite(const glm::dvec3& a, const glm::dvec3& slope_a, const glm::dvec3& b, const glm::dvec3& slope_b,
                   double h, double s) {
  const double s2 = s * s, s3 = s2 * s;
  return (2.0 * s3 - 3.0 * s2 + 1.0) * a + (s3 - 2.0 * s2 + s) * h * slope_a + (3.0 * s2 - 2.0 * s3) * b +
         (s3 - s2) * h * slope_b;
}

/// The Bézier curve of four turns (K. Shoemake, Animating rotation with quaternion curves, 1985).
glm::dquat bezier(const glm::dquat& a, const glm::dquat& b, const glm::dquat& c, const glm::dquat& d, double s) {
  const glm::dquat ab = glm::slerp(a, b, s), bc = glm::slerp(b, c, s), cd = glm::slerp(c, d, s);
  return glm::slerp(glm::slerp(ab, bc, s), glm::slerp(bc, cd, s), s);
}

/// q or -q, which is the same turn: the one nearer to the other.
glm::dquat beside(const glm::dquat& q, const glm::dquat& other) { return glm::dot(q, other) < 0.0 ? -q : q; }

}  // namespace

CameraPath::CameraPath(std::vector<CameraKey> keys) : keys_(std::move(keys)) { assert(!keys_.empty()); }

Camera CameraPath::at(double frame) const {
  const auto behind = std::ranges::upper_bound(keys_, frame, {}, [](const CameraKey& key) { return key.frame; });
  if (behind == keys_.begin()) return keys_.front().camera;
  if (behind == keys_.end()) return keys_.back().camera;
  const std::size_t j = static_cast<std::size_t>(behind - keys_.begin()), i = j - 1;
  if (frame == keys_[i].frame) return keys_[i].camera;  // to the last bit
  const std::size_t before = i == 0 ? i : i - 1, after = std::min(j + 1, keys_.size() - 1);
  Pose pose[4] = {pose_of(keys_[before].camera), pose_of(keys_[i].camera), pose_of(keys_[j].camera),
                  pose_of(keys_[after].camera)};
  for (int n = 1; n < 4; ++n) pose[n].axes = beside(pose[n].axes, pose[n - 1].axes);
  const double h = keys_[j].frame - keys_[i].frame, s = (frame - keys_[i].frame) / h;
  const auto slope = [&](const glm::dvec3 Pose::*part, int from, int to, std::size_t key_from, std::size_t key_to) {
    return (pose[to].*part - pose[from].*part) / (keys_[key_to].frame - keys_[key_from].frame);
  };
  const auto curve = [&](const glm::dvec3 Pose::*part) {
    return hermite(pose[1].*part, slope(part, 0, 2, before, j), pose[2].*part, slope(part, 1, 3, i, after), h, s);
  };
  // The turn over a third of this interval at the pace at each of its ends.
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

}  // namespace meniscus
