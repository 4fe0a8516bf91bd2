// SPDX-License-Identifier: BSD-3-Clause
// The oracle itself against closed forms and against plain sampling of the accessible region.
#include <cmath>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/sphere_tracer.h"

namespace meniscus::testing {
namespace {

constexpr double kProbe = 1.4;

glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

TEST(SphereTracer, OneAtomIsItsSphere) {
  const std::vector<Ball> balls{{{1, 2, 3}, 1.7}};
  const SphereTracer tracer(balls, kProbe);
  std::mt19937 random(1);
  for (int n = 0; n < 200; ++n) {
    const glm::dvec3 d = random_direction(random);
    const auto hit = tracer.trace(balls[0].center - 20.0 * d, d);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->t, 20.0 - 1.7, 1e-8);
    EXPECT_NEAR(glm::dot(hit->normal, -d), 1.0, 1e-9);
    EXPECT_EQ(hit->probe.kind, PatchKind::convex);
  }
}

TEST(SphereTracer, TwoAtomsHaveTheirTorusBetweenThem) {
  const std::vector<Ball> balls{{{-2, 0, 0}, 1.5}, {{2, 0, 0}, 1.5}};
  const SphereTracer tracer(balls, kProbe);
  const double major = std::sqrt(2.9 * 2.9 - 4.0);
  const auto hit = tracer.trace({0, 10, 0}, {0, -1, 0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->probe.kind, PatchKind::toroidal);
  EXPECT_NEAR(10.0 - hit->t, major - kProbe, 1e-8);
  EXPECT_FALSE(tracer.trace({0, 10, 5}, {0, -1, 0}));
}

TEST(SphereTracer, SpindleLeavesItsAxisFree) {
  // Circle radius 1.0 < p: past the cusp at x = sqrt(p^2 - 1) the axis is in the solvent.
  const double half = std::sqrt(2.9 * 2.9 - 1.0);
  const std::vector<Ball> balls{{{-half, 0, 0}, 1.5}, {{half, 0, 0}, 1.5}};
  const SphereTracer tracer(balls, kProbe);
  EXPECT_FALSE(tracer.trace({0, 10, 0}, {0, -1, 0}));
  const auto tip = tracer.trace({0, 0, 0}, {1, 0, 0});
  ASSERT_TRUE(tip);
  EXPECT_NEAR(tip->t, std::sqrt(kProbe * kProbe - 1.0), 1e-7);
}

TEST(SphereTracer, ProbeRadiusZeroIsTheUnionOfBalls) {
  const std::vector<Ball> balls{{{-1, 0, 0}, 1.5}, {{1, 0, 0}, 1.2}};
  const SphereTracer tracer(balls, 0.0);
  const auto hit = tracer.trace({10, 0.1, 0}, {-1, 0, 0});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 10.0 - (1.0 + std::sqrt(1.44 - 0.01)), 1e-8);
  EXPECT_EQ(hit->probe.atom[0], 1u);
}

// A = complement of the balls: any sampled point of A gives an upper bound of the distance, and the returned probe
// must itself be in A (within rounding) at the returned distance.
TEST(SphereTracer, NearestProbeIsAccessibleAndNoSampleIsNearer) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  std::vector<Ball> balls;
  for (int n = 0; n < 25; ++n) balls.push_back({{uniform(random), uniform(random), uniform(random)}, 1.2 + 0.02 * n});
  const SphereTracer tracer(balls, kProbe, 1.0);
  std::vector<glm::dvec3> accessible;
  std::uniform_real_distribution<double> wide(-7.0, 7.0);
  while (accessible.size() < 20000) {
    const glm::dvec3 y(wide(random), wide(random), wide(random));
    bool free = true;
    for (const Ball& b : balls) free = free && glm::distance(y, b.center) >= b.radius + kProbe;
    if (free) accessible.push_back(y);
  }
  int measured = 0;
  for (int n = 0; n < 500; ++n) {
    const glm::dvec3 x = 2.0 * glm::dvec3(uniform(random), uniform(random), uniform(random));
    const NearestProbe probe = tracer.nearest(x);
    double sampled = 1e300;
    for (const glm::dvec3& y : accessible) sampled = std::min(sampled, glm::distance(x, y));
    EXPECT_LE(probe.distance, sampled + 1e-12);
    if (probe.distance >= tracer.reach() || probe.distance == 0.0) continue;
    ++measured;
    EXPECT_NEAR(glm::distance(x, probe.center), probe.distance, 1e-12);
    EXPECT_LT(sampled - probe.distance, 0.8);
    for (const Ball& b : balls) EXPECT_GE(glm::distance(probe.center, b.center), b.radius + kProbe - 1e-8);
  }
  EXPECT_GT(measured, 100);
}

TEST(SphereTracer, DegenerateSquareIsWhole) {
  // Four atoms on one probe: the trough above the middle ends at the probe's lowest point.
  std::vector<Ball> balls;
  for (const double x : {-1.9, 1.9})
    for (const double y : {-1.9, 1.9}) balls.push_back({{x, y, 0}, 1.7});
  const SphereTracer tracer(balls, kProbe);
  const double height = std::sqrt(3.1 * 3.1 - 2 * 1.9 * 1.9);
  const auto hit = tracer.trace({0, 0, 10}, {0, 0, -1});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(10.0 - hit->t, height - kProbe, 1e-6);
}

}  // namespace
}  // namespace meniscus::testing
