// SPDX-License-Identifier: BSD-3-Clause
// Values that change steadily between two figures of a film end in their places, and are intermediate on the way.
#include "core/scene/transition.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace meniscus {
namespace {

double half_height_at_target(const Camera& camera) {
  const double half = half_extent(camera, 1.0).y;
  return camera.projection == Projection::orthographic ? half : half * glm::distance(camera.position, camera.target);
}

TEST(CameraBetween, EndsAtBothAndKeepsItsProjection) {
  const Camera one{{0.0, 0.0, 50.0}, {1.0, 2.0, 3.0}, {0.0, 1.0, 0.0}, Projection::perspective, 25.0, 1.0};
  const Camera other{{-70.0, 5.0, 9.0}, {4.0, -2.0, 0.0}, {0.0, 0.2, 1.0}, Projection::orthographic, 30.0, 18.0};
  for (const auto& [from, to] : {std::pair(one, other), std::pair(other, one)}) {
    const Camera start = camera_between(from, to, 0.0), end = camera_between(from, to, 1.0);
    EXPECT_EQ(start.position, from.position);
    EXPECT_EQ(end.projection, from.projection);
    EXPECT_NEAR(glm::distance(end.target, to.target), 0.0, 1e-9);
    EXPECT_NEAR(half_height_at_target(end), half_height_at_target(to), 1e-9);
    EXPECT_NEAR(glm::dot(view_basis(end).forward, view_basis(to).forward), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(view_basis(end).right, view_basis(to).right), 1.0, 1e-12);
    const Camera middle = camera_between(from, to, 0.5);
    EXPECT_NEAR(half_height_at_target(middle), std::sqrt(half_height_at_target(from) * half_height_at_target(to)),
                0.35 * half_height_at_target(middle));
  }
}

TEST(PlanesBetween, MoveTurnLeaveAndCome) {
  const std::vector<Ball> balls{{{0.0, 0.0, 0.0}, 2.0}, {{10.0, 0.0, 0.0}, 3.0}};  // Their extent in x is -2 to 13.
  const ClipPlane x5{{1.0, 0.0, 0.0}, 5.0}, x9{{1.0, 0.0, 0.0}, 9.0}, y0{{0.0, 1.0, 0.0}, 0.0};
  const auto moved = planes_between(std::vector{x5}, std::vector{x9}, balls, 0.25);
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_DOUBLE_EQ(moved[0].offset, 6.0);

  // Turned about what is beside it of the middle of all, (5, 0, 0), which the plane x = 5 goes through and y = 0 too.
  const ClipPlane slanted{glm::normalize(glm::dvec3(1.0, 1.0, 0.0)), 5.0 / std::numbers::sqrt2};
  for (const double share : {0.1, 0.5, 0.9}) {
    const auto turned = planes_between(std::vector{x5}, std::vector{slanted}, balls, share);
    ASSERT_EQ(turned.size(), 1u);
    EXPECT_NEAR(glm::length(turned[0].normal), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(turned[0].normal, glm::dvec3(5.0, 0.0, 0.0)), turned[0].offset, 1e-12);
  }

  const auto crossing = planes_between(std::vector{x5}, std::vector{y0}, balls, 0.5);
  ASSERT_EQ(crossing.size(), 2u);
  EXPECT_DOUBLE_EQ(crossing[0].offset, 9.0);  // half the way to 13
  EXPECT_DOUBLE_EQ(crossing[1].offset, 1.5);  // half the way from 3
  const auto gone = planes_between(std::vector{x5}, {}, balls, 1.0);
  EXPECT_TRUE(gone.empty());
  const auto first = planes_between(std::vector{x5, y0}, std::vector{x9}, balls, 0.0);
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[0].offset, 5.0);
  EXPECT_EQ(first[1].offset, 0.0);
}

TEST(LookBetween, NumbersGoOverAndEndExactly) {
  Look from, to;
  from.ambient_occlusion = 0.2f;
  to.ambient_occlusion = 0.7f;
  from.light_direction = {2.0f, 0.0f, 0.0f};
  to.light_direction = {0.0f, 0.0f, 5.0f};
  to.outer_lines = 3.0f;
  to.ambient_occlusion_rays = 64.0f;
  const Look middle = look_between(from, to, 0.5);
  EXPECT_FLOAT_EQ(middle.ambient_occlusion, 0.45f);
  EXPECT_FLOAT_EQ(middle.light_direction.x, middle.light_direction.z);
  EXPECT_FLOAT_EQ(middle.outer_lines.value_or(-1.0f), 1.5f);
  EXPECT_EQ(middle.ambient_occlusion_rays, 0.0f) << "few rays are noise";
  EXPECT_EQ(look_between(from, to, 1.0).ambient_occlusion, 0.7f);
  EXPECT_FALSE(look_between(from, to, 1.0) == look_between(to, from, 0.0)) << "rays differ, so pictures dissolve";
  to.ambient_occlusion_rays = 0.0f;
  EXPECT_TRUE(look_between(from, to, 1.0) == look_between(to, from, 0.0));
  to.lamps = Lamps::white;
  EXPECT_FALSE(look_between(from, to, 1.0) == look_between(to, from, 0.0));
}

}  // namespace
}  // namespace meniscus
