// SPDX-License-Identifier: BSD-3-Clause
// The ray caster's geometry in double: every root found, none invented, patches as theorem 1 says.
#include "core/render/ray_geometry.h"

#include <array>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_rays.h"

namespace meniscus {
namespace {

/// Returns the distance to the torus tube in the half-plane of x, without the lemon: sqrt((rho - R)^2 + z^2) - p.
double tube(const glm::dvec3& x, double major, double minor) {
  return std::hypot(std::hypot(x.x, x.y) - major, x.z) - minor;
}

TEST(RayTorus, FindsExactlyTheSignChangesOfADenseScan) {
  std::mt19937 random(1);
  int root_count = 0, spindle_root_count = 0;
  for (int n = 0; n < 1000; ++n) {
    const testing::TorusQuery q = testing::random_torus_query(random);
    const auto value = [&](double t) { return tube(q.origin + q.direction * t, q.major, q.minor); };
    const geometry::TorusHits hits = geometry::ray_torus(q.origin, q.direction, q.major, q.minor, -12, 12, 1e-14);
    std::vector<double> roots(hits.t, hits.t + hits.count);
    for (const double t : roots) EXPECT_LT(std::abs(value(t)), 1e-11) << n;
    EXPECT_TRUE(std::is_sorted(roots.begin(), roots.end()));
    int crossings = 0;
    double closest_to_touching = 1.0;
    constexpr int kSteps = 6000;
    double before = value(-12.0);
    for (int i = 1; i <= kSteps; ++i) {
      const double after = value(-12.0 + 24.0 * i / kSteps);
      if ((before > 0.0) != (after > 0.0))
        ++crossings;
      else
        closest_to_touching = std::min(closest_to_touching, std::abs(after));
      before = after;
    }
    // Where the ray almost touches, a scan of this step may overlook two crossings.
    if (closest_to_touching > 4e-3 || crossings == hits.count)
      EXPECT_EQ(hits.count, crossings) << n;
    else
      EXPECT_EQ(hits.count % 2, crossings % 2) << n;
    root_count += hits.count;
    if (q.major < q.minor) spindle_root_count += hits.count;
  }
  EXPECT_GT(root_count, 1000);  // Enough roots were tested, spindles' too.
  EXPECT_GT(spindle_root_count, 300);
}

TEST(RayTorus, RespectsItsInterval) {
  // The ray along x through a torus with R = 3, p = 1 has roots at -4, -2, 2, 4.
  const glm::dvec3 o(0.0), d(1.0, 0.0, 0.0);
  const auto all = geometry::ray_torus(o, d, 3.0, 1.0, -10, 10, 1e-15);
  ASSERT_EQ(all.count, 4);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(all.t[i], (std::array{-4.0, -2.0, 2.0, 4.0})[i], 1e-14);
  const auto some = geometry::ray_torus(o, d, 3.0, 1.0, -3.5, 3.0, 1e-15);
  ASSERT_EQ(some.count, 2);
  EXPECT_NEAR(some.t[0], -2.0, 1e-14);
  EXPECT_NEAR(some.t[1], 2.0, 1e-14);
  EXPECT_EQ(geometry::ray_torus(o, d, 3.0, 1.0, -1.9, 1.9, 1e-15).count, 0);
}

TEST(ToroidalPatch, KeepsInnerSideSlabAndArc) {
  const auto inside = [](double rho, double angle, double z, double sweep) {
    const int range = sweep > 6.28                ? geometry::kWholeTurn
                      : sweep <= std::numbers::pi ? geometry::kUpToHalfTurn
                                                  : geometry::kOverHalfTurn;
    return geometry::in_toroidal_patch({rho * std::cos(angle), rho * std::sin(angle), z}, 3.0, -0.5, 0.7,
                                       std::cos(sweep), std::sin(sweep), range, 1e-9);
  };
  const double whole = 2.0 * std::numbers::pi;
  EXPECT_TRUE(inside(2.1, 1.0, 0.0, whole));
  EXPECT_FALSE(inside(3.1, 1.0, 0.0, whole));
  EXPECT_FALSE(inside(2.1, 1.0, -0.6, whole));
  EXPECT_FALSE(inside(2.1, 1.0, 0.8, whole));
  for (const double sweep : {0.3, 1.5, 3.0, std::numbers::pi, 3.3, 5.0, 6.2})
    for (double angle = 0.01; angle < whole; angle += 0.05)
      EXPECT_EQ(inside(2.1, angle, 0.0, sweep), angle <= sweep) << angle << " of " << sweep;
}

TEST(ToroidalPatch, NormalPointsToTheProbe) {
  std::mt19937 random(2);
  for (int n = 0; n < 100; ++n) {
    const testing::TorusQuery q = testing::random_torus_query(random);
    const auto hits = geometry::ray_torus(q.origin, q.direction, q.major, q.minor, -12, 12, 1e-14);
    for (int i = 0; i < hits.count; ++i) {
      const glm::dvec3 x = q.origin + q.direction * hits.t[i];
      const double rho = std::hypot(x.x, x.y);
      const glm::dvec3 probe(x.x / rho * q.major, x.y / rho * q.major, 0.0);
      EXPECT_LT(glm::length(geometry::torus_normal(x, q.major, q.minor) - (probe - x) / q.minor), 1e-10);
    }
  }
}

TEST(RaySphere, AgreesWithTheClosedForm) {
  const auto hits = geometry::ray_sphere({0.0, 0.6, -5.0}, {0.0, 0.0, 1.0}, 1.0);
  EXPECT_TRUE(hits.found);
  EXPECT_NEAR(hits.near_t, 4.2, 1e-14);
  EXPECT_NEAR(hits.far_t, 5.8, 1e-14);
  EXPECT_FALSE(geometry::ray_sphere({0.0, 1.01, -5.0}, {0.0, 0.0, 1.0}, 1.0).found);
}

}  // namespace
}  // namespace meniscus
