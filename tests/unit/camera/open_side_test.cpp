// SPDX-License-Identifier: BSD-3-Clause
// Tests how deep a plane must be for some balls to be seen behind others, and which side of them shows more.
#include "core/camera/open_side.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/camera/view_request.h"
#include "core/math/ball.h"

namespace meniscus {
namespace {

using Balls = std::vector<Ball>;

/// Returns a camera that looks along -z at the origin.
Camera camera_at(double z, Projection projection = Projection::orthographic) {
  Camera camera;
  camera.position = {0.0, 0.0, z};
  camera.projection = projection;
  camera.height = 20.0;
  return camera;
}

/// Adds balls close together at this height, but for those nearer to the line x = y = 0 than `hole`.
void add_wall(Balls& balls, double z, double hole = 0.0) {
  for (int x = -8; x <= 8; ++x)
    for (int y = -8; y <= 8; ++y)
      if (std::hypot(x, y) >= hole) balls.push_back({{x, y, z}, 1.7});
}

constexpr double kBehindWall = -(10.0 - 1.7);  // depth; the surface is somewhat wider than its balls

TEST(OpenDepth, IsBehindWhatHides) {
  const Balls seen{{{-2, 0, 0}, 1.7}, {{2, 0, 0}, 1.7}};
  Balls all;
  add_wall(all, 10.0);
  add_wall(all, 20.0);
  add_wall(all, -10.0);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    const OpenDepth open = open_depth(seen, all, camera_at(60.0, projection));
    EXPECT_NEAR(open.depth, kBehindWall, 0.8);
    EXPECT_GT(open.depth, kBehindWall);
    EXPECT_GE(open.seen, 0.95);
    EXPECT_FALSE(open.is_limited);
  }
}

TEST(OpenDepth, LeavesAWallThatHidesNothing) {
  const Balls seen{{{0, 0, 0}, 1.7}};
  Balls all;
  add_wall(all, 10.0, 4.0);
  const OpenDepth open = open_depth(seen, all, camera_at(60.0));
  EXPECT_LE(open.depth, -11.7);
  EXPECT_EQ(open.seen, 1.0);
  // A speck may stay, which hides less than a twentieth; a ball may not.
  all.push_back({{0, 0, 10}, -0.25});
  EXPECT_LE(open_depth(seen, all, camera_at(60.0)).depth, -11.7);
  all.push_back({{0, 0, 10}, 0.2});
  EXPECT_NEAR(open_depth(seen, all, camera_at(60.0)).depth, -10.0, 0.7);
}

TEST(OpenDepth, DoesNotCutWhatIsToBeSeen) {
  const Balls seen{{{-4, 0, 0}, 1.7}, {{4, 0, 6}, 1.7}};
  Balls all{{{-4, 0, 4}, 1.7}};
  const double between = -(4.0 - 1.7);
  EXPECT_NEAR(open_depth(seen, all, camera_at(60.0)).depth, between, 0.6);
  all.insert(all.end(), seen.begin(), seen.end());
  for (Ball& ball : all) ball.radius += 0.5;  // The balls are another kind of surface of the same atoms.
  const OpenDepth open = open_depth(seen, all, camera_at(60.0));
  EXPECT_DOUBLE_EQ(open.depth, -(6.0 + 2.2));
  EXPECT_TRUE(open.is_limited);
  EXPECT_NEAR(open.seen, 0.5, 0.05);
}

TEST(OpenDepth, IgnoresWhatIsBehindTheCamera) {
  const Balls seen{{{0, 0, 0}, 1.7}};
  Balls all;
  add_wall(all, 80.0);
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    EXPECT_EQ(open_depth(seen, all, camera_at(60.0, projection)).seen, 1.0);
}

/// The axes of a view along -z, and balls with their groups: a wall, and balls behind it.
struct Walled {
  const ViewBasis view{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  Balls balls;
  std::vector<std::uint32_t> group;

  Walled() {
    add_wall(balls, 0.0);
    group.assign(balls.size(), 0);
    add(-6.0, 1);
  }
  /// Adds a ball of a group at this height.
  void add(double z, std::uint32_t of_group) {
    balls.push_back({{1.0, 2.0, z}, 2.0});
    group.push_back(of_group);
  }
  bool shows_more_behind() const { return meniscus::shows_more_behind(view, balls, group); }
};

TEST(ShowsMoreBehind, OfWhatAWallHides) {
  Walled walled;
  EXPECT_TRUE(walled.shows_more_behind());
  walled.add(6.0, 2);  // As much is now in front of the wall.
  EXPECT_FALSE(walled.shows_more_behind());
}

TEST(ShowsMoreBehind, IsFalseForTheSideThatShowsMore) {
  Walled walled;
  for (Ball& ball : walled.balls) ball.center.z = -ball.center.z;
  EXPECT_FALSE(walled.shows_more_behind());
}

TEST(ShowsMoreBehind, IsFalseForOneGroupAndForBallsThatDoNotCount) {
  Walled walled;
  walled.group.back() = kCountedGroups;
  EXPECT_FALSE(walled.shows_more_behind());
  walled.group.back() = 0;
  EXPECT_FALSE(walled.shows_more_behind());
}

TEST(ShowsMoreBehind, TurnsTheUsualView) {
  const Walled walled;
  ViewRequest request;
  const ViewBasis usual = aimed_basis(request, {}, {walled.balls, walled.balls, {}});
  const ViewBasis other = aimed_basis(request, {}, {walled.balls, walled.balls, {}, -usual.forward});
  EXPECT_EQ(other.forward, -usual.forward);
  EXPECT_EQ(other.up, usual.up);
  request.direction = parse_view_direction("front");
  EXPECT_EQ(aimed_basis(request, {}, {walled.balls, walled.balls, {}, -usual.forward}).forward, other.forward);
}

}  // namespace
}  // namespace meniscus
