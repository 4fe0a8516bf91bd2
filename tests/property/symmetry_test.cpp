// SPDX-License-Identifier: BSD-3-Clause
// Copies about a symmetry axis, like in virus capsids: exact, or as far off as matrices in files, always closed.
#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

/// Returns a few random balls, some on the axis, `fold` times about a random axis, each copy shaken by `jitter` Å.
Balls symmetric_gas(int fold, double jitter, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::normal_distribution<double> normal;
  const auto vector = [&](auto& distribution) {
    return glm::dvec3{distribution(random), distribution(random), distribution(random)};  // The order is fixed.
  };
  const glm::dvec3 axis = glm::normalize(vector(normal)), origin = 100.0 * vector(unit);
  constexpr double kRadii[] = {1.7, 1.55, 1.52, 1.8, 1.2};
  Balls part;
  for (std::uint32_t n = 0, count = 1 + random() % 5; n < count; ++n)
    part.push_back({4.0 * vector(unit), kRadii[random() % 5]});
  if (random() % 3 == 0) part.push_back({4.0 * unit(random) * axis, 1.7});
  Balls balls;
  for (int copy = 0; copy < fold; ++copy) {
    const double angle = 2 * std::numbers::pi * copy / fold;
    for (const Ball& ball : part) {
      const glm::dvec3 along = axis * glm::dot(axis, ball.center), across = ball.center - along;
      const glm::dvec3 turned = along + std::cos(angle) * across + std::sin(angle) * glm::cross(axis, across);
      balls.push_back({origin + turned + jitter * vector(normal), ball.radius});
    }
  }
  return balls;
}

class Symmetry : public ::testing::TestWithParam<double> {};

constexpr double kProbes[] = {0.7, 1.4, 3.0};

TEST_P(Symmetry, IsClosed) {
  std::mt19937 random(11);
  for (int n = 0; n < 300; ++n) {
    const Balls balls = symmetric_gas(2 + n % 5, GetParam(), random);
    EXPECT_NO_THROW(compute_surface_cpu(balls, kProbes[n % 3])) << n << "-th of jitter " << GetParam();
  }
}

INSTANTIATE_TEST_SUITE_P(Jitters, Symmetry, ::testing::Values(0.0, 1e-14, 1e-12, 1e-10, 1e-9, 1e-4, 1e-3));

// Two probes as near as the shaking, and a third that passes their circle's axis: what neighbours on a circle cannot do
// must be known, for it cannot be computed. 17 of these close only because radii grow slightly (compute_surface.h);
// that many more do would be a rule forgotten, which the growth hides.
TEST(Symmetry, OfTheHardestAllAreClosed) {
  std::mt19937 random(12);
  int grown = 0;
  for (int n = 0; n < 3200; ++n) {
    const Balls balls = symmetric_gas(2 + n % 5, std::pow(10.0, -5 - n % 4), random);
    SCOPED_TRACE(n);
    EXPECT_NO_THROW(grown += compute_surface_cpu(balls, kProbes[n % 3]).certificate.grown_by > 0);
  }
  EXPECT_LE(grown, 22);
}

// The five phenylalanine rings about a five-fold axis of the Norwalk virus capsid (1IHM), whose matrices have six
// decimals: two fixed probes 2.6e-6 Å apart beside the axis cusps of two spindle circles.
TEST(Symmetry, ProbesOfRoundedCopiesBesideAnAxisCusp) {
  const Balls balls{
      {{-1.46, -136.054, 80.988}, 1.7},    {{-4.058, -140.479, 73.517}, 1.7},   {{-3.179, -138.527, 72.397}, 1.7},
      {{-4.153, -137.736, 72.999}, 1.7},   {{-4.901, -141.972, 70.618}, 1.55},  {{2.0552, -135.8267, 81.3558}, 1.7},
      {{2.6618, -132.7048, 83.7869}, 1.7}, {{2.7302, -133.9988, 84.3133}, 1.7}, {{-0.3678, -133.0965, 85.7733}, 1.7}};
  EXPECT_NO_THROW(compute_surface_cpu(balls, 1.4));
}

}  // namespace
}  // namespace meniscus::testing
