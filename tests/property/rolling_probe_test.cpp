// SPDX-License-Identifier: BSD-3-Clause
// Two ways to the reduced surface that share only their predicates find the same arcs: enumeration and rolling probe.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "app/bench/rolling_probe.h"
#include "core/reduced_surface/reduced_surface.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

std::size_t face_count(const ReducedSurface& rs) {
  std::size_t ends = 0;
  for (const RsArc& arc : rs.arcs) ends += arc.begin_by == kNone ? 0 : 2;
  return ends / 3;
}

void expect_same_arcs(const Balls& balls, double probe_radius) {
  const ReducedSurface enumerated = enumerate_reduced_surface(balls, probe_radius);
  const ReducedSurface rolled = roll_probe(balls, probe_radius);
  EXPECT_EQ(enumerated.arcs, rolled.arcs);
  EXPECT_EQ(enumerated.lone_atoms, rolled.lone_atoms);
  const ReducedSurface outer = roll_probe(balls, probe_radius, RollingScope::outer_component);
  EXPECT_FALSE(outer.arcs.empty() && outer.lone_atoms.empty());
  EXPECT_TRUE(std::includes(rolled.arcs.begin(), rolled.arcs.end(), outer.arcs.begin(), outer.arcs.end()));
  EXPECT_TRUE(std::includes(rolled.lone_atoms.begin(), rolled.lone_atoms.end(), outer.lone_atoms.begin(),
                            outer.lone_atoms.end()));
}

TEST(RollingProbe, DegenerateMolecules) {
  std::mt19937 random(1);
  for (const NamedBalls& molecule : degenerate_molecules()) {
    SCOPED_TRACE(molecule.name);
    expect_same_arcs(molecule.balls, molecule.probe_radius);
    for (int n = 0; n < 10; ++n)
      expect_same_arcs(rotated(molecule.balls, random_rotation(random)), molecule.probe_radius);
  }
}

TEST(RollingProbe, Gases) {
  for (std::uint32_t n = 0; n < 1000; ++n) {
    SCOPED_TRACE("gas " + std::to_string(n));
    const GasCase gas = gas_case(n);
    expect_same_arcs(gas.balls, gas.probe_radius);
  }
}

// The outer components alone have the sizes that other implementations of the algorithm report for these radii.
TEST(RollingProbe, Ubiquitin) {
  const Balls balls = ubiquitin();
  for (const double p : {0.0, 0.5, 1.4, 4.0}) expect_same_arcs(balls, p);
  EXPECT_EQ(face_count(roll_probe(balls, kWater)), 860u);
  EXPECT_EQ(face_count(roll_probe(balls, kWater, RollingScope::outer_component)), 846u);
}

TEST(RollingProbe, Enterotoxin) {
  const Balls balls = enterotoxin();
  expect_same_arcs(balls, kWater);
  EXPECT_EQ(face_count(roll_probe(balls, kWater)), 6460u);
  EXPECT_EQ(face_count(roll_probe(balls, kWater, RollingScope::outer_component)), 5610u);
}

TEST(RollingProbe, NoAtoms) { EXPECT_EQ(roll_probe({}, 1.4, RollingScope::outer_component), ReducedSurface{}); }

}  // namespace
}  // namespace meniscus::testing
