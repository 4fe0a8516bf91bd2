// SPDX-License-Identifier: BSD-3-Clause
// Caps of a sphere within others: what is left out covers nothing that others do not cover, however near they come.
#include "core/reduced_surface/contour/contour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace meniscus {
namespace {

glm::dvec3 direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

/// Returns how far (Å²) a point is within a ball, by its power.
double depth(const Blockers::Ball& ball, const glm::dvec3& x) {
  const glm::dvec3 d = x - ball.center;
  return ball.weight - glm::dot(d, d);
}

/// Visits points of a cap's border, moved inwards by a share of it.
template <typename Visit>
void for_each_point(double first_weight, const Blockers::Ball& ball, std::mt19937& random, const Visit& visit) {
  const glm::dvec3 axis = ball.center / ball.distance;
  const double height = ball.half_power / ball.distance, widest = std::acos(height / std::sqrt(first_weight));
  for (int n = 0; n < 40; ++n) {
    const glm::dvec3 side = glm::normalize(glm::cross(axis, direction(random)));
    const double angle = widest * (n % 4 == 3 ? 0.5 : 1.0);
    visit(std::sqrt(first_weight) * (std::cos(angle) * axis + std::sin(angle) * side));
  }
}

TEST(NestedCaps, CoverNothingAlone) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> one(0.0, 1.0);
  std::size_t nested_count = 0;
  double nearest = 1.0;
  NestedCaps caps;
  for (int trial = 0; trial < 200; ++trial) {
    Blockers blockers;
    blockers.restart(9.0);
    const double spread = std::pow(10.0, -8.0 * one(random));  // directions, and so borders, come near each other
    const glm::dvec3 about = direction(random);
    for (std::uint32_t n = 0; n < 120; ++n) {
      const double part = trial % 2 == 0 ? 1.0 : spread, radius = 3.0 + part * (one(random) - 0.5);
      const double distance = 2.0 + part * (one(random) - 0.5);
      blockers.add(distance * glm::normalize(about + spread * direction(random)), radius * radius, n);
    }
    const std::vector<std::uint8_t> nested = caps.find(blockers);
    for (std::size_t n = 0; n < blockers.size(); ++n) {
      if (!nested[n]) continue;
      ++nested_count;
      for_each_point(9.0, blockers[n], random, [&](const glm::dvec3& x) {
        double deepest = -1.0;
        for (std::size_t m = 0; m < blockers.size(); ++m)
          if (!nested[m]) deepest = std::max(deepest, depth(blockers[m], x));
        ASSERT_GT(deepest, 1e-8);  // more than decision weights change
        nearest = std::min(nearest, deepest);
      });
    }
  }
  EXPECT_GT(nested_count, 2000u);
  EXPECT_LT(nearest, 1e-4);
}

TEST(NestedCaps, LeaveFewOfALineOfBalls) {
  Blockers blockers;
  blockers.restart(9.0);
  for (std::uint32_t n = 1; n <= 500; ++n)
    for (const double side : {-1.0, 1.0}) blockers.add({side * 0.001 * n, 0.0, 0.0}, 9.0, n);
  const std::vector<std::uint8_t> nested = NestedCaps().find(blockers);
  EXPECT_EQ(nested[0] + nested[1], 0);  // the next ones
  EXPECT_GT(std::count(nested.begin(), nested.end(), 1), 980);
}

// Growth decides whether such caps cross where they touch.
TEST(NestedCaps, StayWhereBordersTouch) {
  Blockers blockers;
  blockers.restart(9.0);
  for (std::uint32_t n = 0; n < 100; ++n) {  // a ring of balls through the point (0, 0, 3) of the sphere
    const double angle = 0.02 * (n + 1);
    const glm::dvec3 center(3.0 * std::sin(angle), 0.0, 3.0 - 3.0 * std::cos(angle));
    blockers.add(center, 9.0, n);
  }
  const std::vector<std::uint8_t> nested = NestedCaps().find(blockers);
  EXPECT_EQ(std::count(nested.begin(), nested.end(), 1), 0);
}

}  // namespace
}  // namespace meniscus
