// SPDX-License-Identifier: BSD-3-Clause
// Points in the solvent against the oracle that knows only the balls.
#include "core/queries/surface_parts.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/molecules.h"
#include "tests/support/sanitized.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus {
namespace {

TEST(Solvent, EveryPointIsOnTheSideTheOracleSays) {
  const testing::Balls atoms = testing::ubiquitin();
  for (const double probe_radius : {0.7, 1.4, 3.0}) {
    const testing::SphereTracer oracle(atoms, probe_radius);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> offset(-5.0, 5.0);
    int in_solvent_count = 0, near_count = 0;
    const int count = test::samples(1500);
    for (int n = 0; n < count; ++n) {
      const glm::dvec3 point =
          atoms[random() % atoms.size()].center + glm::dvec3(offset(random), offset(random), offset(random));
      const double distance = oracle.nearest(point).distance;
      if (std::abs(distance - probe_radius) < 1e-5) continue;
      EXPECT_EQ(in_solvent(atoms, probe_radius, point), distance < probe_radius) << distance;
      in_solvent_count += distance < probe_radius;
      near_count += distance > 0.0 && distance < probe_radius;
    }
    EXPECT_GT(in_solvent_count, 2 * count / 15);
    EXPECT_GT(near_count, count / 30);  // Points are under SAS balls and yet outside the solid.
  }
}

}  // namespace
}  // namespace meniscus
