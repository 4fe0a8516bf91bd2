// SPDX-License-Identifier: BSD-3-Clause
// Directions that cover the sphere evenly.
#include "core/math/ball.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace meniscus::testing {
namespace {

TEST(Spiral, NoDirectionIsFartherThanItsStepSays) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const std::size_t count : {12u, 33u, 100u, 377u, 1500u}) {
    const double step = std::sqrt(4 * std::numbers::pi / static_cast<double>(count));
    for (int n = 0; n < 3000; ++n) {
      glm::dvec3 x = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
      if (n % 2) x = glm::normalize(glm::dvec3(step * x.x, step * x.y, n % 4 == 1 ? 1.0 : -1.0));  // near the poles
      double nearest = 2.0;
      for (std::size_t k = 0; k < count; ++k) nearest = std::min(nearest, glm::distance(x, spiral_direction(k, count)));
      EXPECT_LE(nearest, 0.77 * step) << count;
    }
  }
}

}  // namespace
}  // namespace meniscus::testing
