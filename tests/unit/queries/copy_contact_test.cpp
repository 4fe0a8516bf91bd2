// SPDX-License-Identifier: BSD-3-Clause
// The closest pair of balls in different copies is found as by all pairs.
#include "core/queries/copies.h"
#include "core/math/rigid_motion.h"

#include <cmath>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace meniscus {
namespace {

const RigidMotion kHalfTurn{glm::dmat3(-1, 0, 0, 0, -1, 0, 0, 0, 1), {0, 0, 0}};  // a half turn about z

TEST(CopyContact, OneProbeTouchesBothOrNot) {
  const std::vector<Ball> balls{{{5, 0, 0}, 1.5}};
  const std::vector<RigidMotion> motions{{}, kHalfTurn};
  const CopiedBalls group{balls, motions};
  // The copies are 10 Å apart: they touch one probe of radius 3.5 Å or more, 10 = 1.5 + 1.5 + 2 * 3.5.
  EXPECT_FALSE(closest_contact({&group, 1}, 3.49));
  const auto contact = closest_contact({&group, 1}, 3.5);
  ASSERT_TRUE(contact);
  EXPECT_DOUBLE_EQ(contact->distance, 10.0);
  EXPECT_EQ(contact->ball[0].copy, 0u);
  EXPECT_EQ(contact->ball[1].copy, 1u);
}

TEST(CopyContact, BallsOfOneCopyMayTouch) {
  const std::vector<Ball> balls{{{5, 0, 0}, 1.5}, {{6, 0, 0}, 1.5}};
  const std::vector<RigidMotion> motions{{}};
  const CopiedBalls group{balls, motions};
  EXPECT_FALSE(closest_contact({&group, 1}, 1.4));
  const CopiedBalls groups[] = {{std::span(balls).first(1), motions}, {std::span(balls).last(1), motions}};
  EXPECT_TRUE(closest_contact(groups, 1.4)) << "two groups are two surfaces";
}

TEST(CopyContact, IsTheClosestOfAllPairs) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  int contacts = 0;
  for (int n = 0; n < 50; ++n) {
    std::vector<Ball> balls;
    for (int b = 0; b < 30; ++b)
      balls.push_back({12.0 * glm::dvec3(unit(random), unit(random), unit(random)) + glm::dvec3(11, 0, 0),
                       1.5 + 0.4 * unit(random)});
    const std::vector<RigidMotion> motions{{}, kHalfTurn, {glm::dmat3(1.0), {0, 30, 0}}};
    const CopiedBalls group{balls, motions};
    double least = HUGE_VAL;
    for (std::size_t c = 0; c < motions.size(); ++c)
      for (std::size_t d = c + 1; d < motions.size(); ++d)
        for (const Ball& x : balls)
          for (const Ball& y : balls)
            least = std::min(least, glm::distance(motions[c](x.center), motions[d](y.center)) - x.radius - y.radius);
    const auto contact = closest_contact({&group, 1}, 1.4);
    ASSERT_EQ(contact.has_value(), least <= 2.8) << least;
    if (!contact) continue;
    ++contacts;
    const Ball &x = balls[contact->ball[0].ball], &y = balls[contact->ball[1].ball];
    EXPECT_NEAR(contact->distance - x.radius - y.radius, least, 1e-12);
  }
  EXPECT_GT(contacts, 10);
  EXPECT_LT(contacts, 50);
}

}  // namespace
}  // namespace meniscus
