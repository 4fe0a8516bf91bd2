// SPDX-License-Identifier: BSD-3-Clause
// Spheres without arcs: near misses lose no atom, and arcs that are taken away are missed.
#include "core/reduced_surface/reduced_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

double sphere_area(double r) { return 4 * std::numbers::pi * r * r; }

// Returns gaps between SAS spheres from a touch to well beyond the growth that decisions see.
std::vector<double> small_gaps() {
  std::vector<double> gaps{0, 1e-12, 1e-11, 1e-10, 1e-8, 1e-7};
  for (double gap = 1e-9; gap < 4.5e-9; gap += 0.1e-9) gaps.push_back(gap);
  return gaps;
}

ReducedSurface with_arcs(const Balls& balls, double probe_radius, std::vector<RsArc> arcs) {
  ReducedSurface rs;
  rs.arcs = std::move(arcs);
  find_whole_spheres(balls, decision_weights(balls, probe_radius), swallowed_atoms(balls), rs);
  return rs;
}

TEST(WholeSpheres, NearMissesOfTwoAtomsLoseNone) {
  for (const double p : {0.0, 0.5, 1.4, 10.0})
    for (const double other : {kCarbon, 0.3})
      for (const double gap : small_gaps()) {
        const Balls balls{{{1, 2, 3}, kCarbon}, {{1 + kCarbon + other + 2 * p + gap, 2, 3}, other}};
        const Surface s = compute_surface_cpu(balls, p);
        EXPECT_EQ(s.counts().convex, 2u) << p << ' ' << other << ' ' << gap;
        EXPECT_NEAR(s.area, sphere_area(kCarbon) + sphere_area(other), 1e-6) << p << ' ' << other << ' ' << gap;
      }
}

TEST(WholeSpheres, NearMissesOfManyNeighborsLoseNone) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> gap(2e-9, 3.5e-9);
  // Twelve spheres lie around one, and a chain consists of pairs: each pair meets, and nearly meets the next.
  for (int n = 0; n < 50; ++n) {
    Balls star{{{0, 0, 0}, kCarbon}};
    for (const double sign : {1.0, -1.0})
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 center(0.0);
        center[axis] = sign * (2 * (kCarbon + kWater) + gap(random));
        star.push_back({center, kCarbon});
      }
    EXPECT_EQ(compute_surface_cpu(star, kWater).counts().convex, star.size());
    Balls chain;
    double x = 0;
    for (int pair = 0; pair < 5; ++pair) {
      chain.push_back({{x, 0, 0}, kCarbon});
      chain.push_back({{x + 1.5, 0, 0}, kCarbon});
      x += 1.5 + 2 * (kCarbon + kWater) + gap(random);
    }
    EXPECT_EQ(compute_surface_cpu(chain, kWater).counts().convex, chain.size());
  }
}

// Neighbours that nearly touch a sphere where it is asked: other points are.
TEST(WholeSpheres, NearMissesInTheDirectionsThatAreAskedLoseNone) {
  const glm::dvec3 direction(0.36, 0.48, 0.8);
  for (const double gap : small_gaps()) {
    Balls balls{{{0, 0, 0}, kCarbon}};
    for (const double sign : {1.0, -1.0}) balls.push_back({sign * (2 * (kCarbon + kWater) + gap) * direction, kCarbon});
    const Surface s = compute_surface_cpu(balls, kWater);
    EXPECT_EQ(s.counts().convex, 3u) << gap;
    EXPECT_EQ(s.certificate.grown_by, 0.0) << gap;
  }
}

TEST(WholeSpheres, AtomsAnyWayApartAreLone) {
  const Balls balls{{{0, 0, 0}, kCarbon}, {{1e100, 0, 0}, kCarbon}, {{0, -1e160, 0}, kCarbon}};
  EXPECT_EQ(with_arcs(balls, kWater, {}).lone_atoms.size(), 3u);
}

TEST(WholeSpheres, SwallowedAtomsAreNeitherLoneNorLost) {
  const Balls dolls{{{0, 0, 0}, 2.0}, {{0, 0, 0}, 2.0}, {{0.5, 0, 0}, 1.5 + 5e-7}, {{30, 0, 0}, 1.0}};
  const ReducedSurface rs = with_arcs(dolls, kWater, {});
  EXPECT_EQ(rs.lone_atoms, (std::vector<std::uint32_t>{0, 3}));
  EXPECT_TRUE(rs.lost_atoms.empty());
}

TEST(WholeSpheres, MissTheArcsOfAFreeCircle) {
  const Balls pair{{{0, 0, 0}, kCarbon}, {{3, 0, 0}, kCarbon}};
  EXPECT_EQ(with_arcs(pair, kWater, {}).lost_atoms, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_TRUE(with_arcs(pair, kWater, enumerate_reduced_surface(pair, kWater).arcs).lost_atoms.empty());
}

// All arcs of an atom and all others that name it are taken away: some atom is lost, or the rest does not close.
TEST(WholeSpheres, MissAllArcsOfAMolecule) {
  for (const NamedBalls& molecule : degenerate_molecules()) {
    SCOPED_TRACE(molecule.name);
    const ReducedSurface rs = enumerate_reduced_surface(molecule.balls, molecule.probe_radius);
    EXPECT_TRUE(rs.lost_atoms.empty());
    EXPECT_EQ(with_arcs(molecule.balls, molecule.probe_radius, {}).lost_atoms.empty(), rs.arcs.empty());
  }
}

TEST(WholeSpheres, LostAtomsLeaveTheSurfaceOpen) {
  const Balls pair{{{0, 0, 0}, kCarbon}, {{3, 0, 0}, kCarbon}};
  ReducedSurface rs = enumerate_reduced_surface(pair, kWater);
  EXPECT_TRUE(assemble_surface(pair, kWater, rs).certificate.closed);
  rs = with_arcs(pair, kWater, {});
  const Certificate certificate = assemble_surface(pair, kWater, rs).certificate;
  EXPECT_FALSE(certificate.closed);
  EXPECT_EQ(certificate.open_atoms, rs.lost_atoms);
}

}  // namespace
}  // namespace meniscus::testing
