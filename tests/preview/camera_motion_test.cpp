// SPDX-License-Identifier: BSD-3-Clause
// Motions of the camera have their documented properties, from random cameras of both projections.
#include "app/preview/preview_state.h"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/molecules.h"
#include "tests/support/sanitized.h"

namespace meniscus::testing {
namespace {

constexpr glm::dvec2 kSize{1000, 800};

/// Returns where a point is seen in the picture: the column and row of pixel_ray.
glm::dvec2 pixel_of(const Camera& camera, const glm::dvec3& point) {
  const ViewBasis basis = view_basis(camera);
  const glm::dvec3 v = point - camera.position;
  const double depth = camera.projection == Projection::perspective ? glm::dot(v, basis.forward) : 1.0;
  const glm::dvec2 half = half_extent(camera, kSize.x / kSize.y);
  return {0.5 * kSize.x * (1.0 + glm::dot(v, basis.right) / (depth * half.x)),
          0.5 * kSize.y * (1.0 - glm::dot(v, basis.up) / (depth * half.y))};
}

class CameraMotion : public ::testing::TestWithParam<int> {
 protected:
  CameraMotion() : random_(static_cast<unsigned>(GetParam())) {
    camera_.position = point();
    camera_.target = point();
    camera_.up = point();
    camera_.projection = GetParam() % 2 ? Projection::orthographic : Projection::perspective;
    camera_.vertical_fov = 10.0 + 70.0 * share_(random_);
    camera_.height = 1.0 + 50.0 * share_(random_);
  }
  double number() { return 2.0 * share_(random_) - 1.0; }
  glm::dvec3 point() { return 30.0 * glm::dvec3(number(), number(), number()); }
  glm::dvec3 point_in_target_plane() {
    const ViewBasis basis = view_basis(camera_);
    return camera_.target + (basis.right * number() + basis.up * number()) * height_at_target(camera_);
  }

  std::mt19937 random_;
  std::uniform_real_distribution<double> share_;
  Camera camera_;
};

double distance(const Camera& camera) { return glm::length(camera.position - camera.target); }

TEST_P(CameraMotion, OrbitKeepsDistanceAndTarget) {
  Camera moved = camera_;
  for (int n = 0; n < 1000; ++n) moved = orbited(moved, {number(), number()});
  EXPECT_EQ(moved.target, camera_.target);
  EXPECT_NEAR(distance(moved), distance(camera_), 1e-10 * distance(camera_));
  EXPECT_NEAR(glm::length(moved.up), 1.0, 1e-14);
  EXPECT_NEAR(glm::dot(moved.up, view_basis(moved).forward), 0.0, 1e-12);
}

TEST_P(CameraMotion, OrbitTurnsTheFrontWithTheCursor) {
  const glm::dvec3 front = camera_.target - 0.1 * (camera_.target - camera_.position);
  const glm::dvec2 drag{0.02 * number(), 0.02 * number()};
  const glm::dvec2 shift = pixel_of(orbited(camera_, drag), front) - pixel_of(camera_, front);
  EXPECT_GT(glm::dot(glm::normalize(shift), glm::normalize(drag)), 0.999);
}

TEST_P(CameraMotion, ADragOverTheWholeHeightIsHalfATurn) {
  const Camera behind = orbited(camera_, {1.0, 0.0});
  EXPECT_LT(glm::length(view_basis(behind).forward + view_basis(camera_).forward), 1e-12);
  EXPECT_LT(glm::length(view_basis(behind).up - view_basis(camera_).up), 1e-12);
}

TEST_P(CameraMotion, ProjectionsShowTheTargetAlike) {
  const Balls balls = gas(7, 20, 40.0, 1.0, 2.0);
  const bool perspective = camera_.projection == Projection::perspective;
  const Camera other = projected(camera_, perspective ? Projection::orthographic : Projection::perspective, balls);
  const glm::dvec3 point = point_in_target_plane();
  EXPECT_LT(glm::length(pixel_of(other, point) - pixel_of(camera_, point)), 1e-7);
  const Camera back = projected(other, camera_.projection, balls);
  EXPECT_NEAR(height_at_target(back), height_at_target(camera_), 1e-10 * height_at_target(camera_));
}

TEST_P(CameraMotion, AnOrthographicCameraStaysOutsideHoweverItTurns) {
  const Balls balls = gas(8, 30, 60.0, 1.0, 2.0);
  Camera camera = camera_.projection == Projection::perspective
                      ? projected(camera_, Projection::orthographic, balls)
                      : zoomed_to(camera_, std::span(balls).first(1), balls, 1.25);
  for (int n = 0; n < 50; ++n) {
    camera = orbited(camera, {number(), number()});
    const glm::dvec3 forward = view_basis(camera).forward;
    for (const Ball& ball : balls) EXPECT_GT(glm::dot(ball.center - camera.position, forward), ball.radius);
  }
}

TEST_P(CameraMotion, ZoomToFramesWhatIsShown) {
  const Balls balls = gas(9, 40, 50.0, 1.0, 3.0);
  const std::span<const Ball> shown = std::span(balls).subspan(5, 6);
  const Camera camera = zoomed_to(camera_, shown, balls, kSize.x / kSize.y);
  EXPECT_LT(glm::length(view_basis(camera).forward - view_basis(camera_).forward), 1e-12);
  double nearest_edge = 1e9;
  for (const Ball& ball : shown) {
    for (int n = 0; n < 500; ++n) {
      const glm::dvec3 on_ball = ball.center + ball.radius * glm::normalize(point());
      const glm::dvec2 pixel = pixel_of(camera, on_ball);
      nearest_edge = std::min({nearest_edge, pixel.x, pixel.y, kSize.x - pixel.x, kSize.y - pixel.y});
    }
  }
  EXPECT_GE(nearest_edge, 0.0);
  EXPECT_LT(nearest_edge, 0.1 * kSize.y) << "a margin, but no more";
}

INSTANTIATE_TEST_SUITE_P(Random, CameraMotion, ::testing::Range(0, test::samples(20)));

}  // namespace
}  // namespace meniscus::testing
