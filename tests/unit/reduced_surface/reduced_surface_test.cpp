// SPDX-License-Identifier: BSD-3-Clause
// Atoms within others, found from pairs that are kept from frame to frame, are those that are found again.
#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/reduced_surface/reduced_surface.h"
#include "core/math/ball.h"

namespace meniscus {
namespace {

/// Many small balls among large ones.
std::vector<Ball> crowd_of_balls(std::mt19937& random) {
  std::uniform_real_distribution<double> place(0.0, 14.0), radius(0.3, 2.0);
  std::vector<Ball> balls;
  for (int n = 0; n < 600; ++n) balls.push_back({{place(random), place(random), place(random)}, radius(random)});
  return balls;
}

// Whether they move a little, together or apart, far, change their radii or their number.
TEST(SwallowedAtoms, AreThoseOfEachFrameAnew) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  std::vector<Ball> balls = crowd_of_balls(random);
  SwallowedAtoms kept;
  std::size_t swallowed = 0, changes = 0;
  std::vector<bool> before;
  for (int frame = 0; frame < 120; ++frame) {
    const double way = frame % 30 == 29 ? 5.0 : frame % 10 == 9 ? 0.6 : 0.05;
    for (Ball& ball : balls) ball.center += way * glm::dvec3(one(random), one(random), one(random));
    if (frame % 17 == 16) balls[static_cast<std::size_t>(frame)].radius *= 1.5;
    if (frame == 60) balls.resize(500);
    const std::vector<bool> expected = swallowed_atoms(balls);
    ASSERT_EQ(kept.of(balls), expected) << frame;
    swallowed += static_cast<std::size_t>(std::ranges::count(expected, true));
    changes += before.size() == expected.size() && expected != before;
    before = expected;
  }
  EXPECT_GT(swallowed, 1000u);
  EXPECT_GT(changes, 60u);
  EXPECT_TRUE(kept.of({}).empty());
}

}  // namespace
}  // namespace meniscus
