// SPDX-License-Identifier: BSD-3-Clause
// The planes of a convex patch leave what a probe can touch and nothing else, however shallow a cover is; and probes
// are merged where they are within 10⁻⁶ Å, not farther apart.
#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "tests/support/patch_samples.h"

namespace meniscus::testing {
namespace {

/// Returns unit vectors that cover the sphere evenly.
std::vector<glm::dvec3> directions(int count) {
  std::vector<glm::dvec3> all;
  for (int n = 0; n < count; ++n) {
    const double z = 1 - (2 * n + 1.0) / count, rho = std::sqrt(1 - z * z), phi = n * kPi * (3 - std::sqrt(5.0));
    all.emplace_back(rho * std::cos(phi), rho * std::sin(phi), z);
  }
  return all;
}

/// Returns how deep a probe that touches atom a in this direction is in another atom at most: power, Å².
double depth(const Balls& atoms, std::size_t a, const glm::dvec3& direction, double p) {
  const glm::dvec3 probe = atoms[a].center + (atoms[a].radius + p) * direction;
  double deepest = -1e300;
  for (std::size_t b = 0; b < atoms.size(); ++b) {
    if (b == a) continue;
    const glm::dvec3 d = probe - atoms[b].center;
    deepest = std::max(deepest, (atoms[b].radius + p) * (atoms[b].radius + p) - glm::dot(d, d));
  }
  return deepest;
}

/// Counts directions in which the planes of the atoms' patches disagree with the atoms.
int wrong_directions(const Surface& s, const std::vector<glm::dvec3>& all) {
  int wrong = 0;
  for (std::uint32_t c = 0; c < s.convex.size(); ++c) {
    const std::uint32_t a = s.convex[c].atom;
    for (const glm::dvec3& u : all) {
      const double covered = depth(s.atoms, a, u, s.probe_radius);
      if (std::abs(covered) < 1e-6) continue;  // The direction is on a border.
      const glm::dvec3 point = s.atoms[a].center + s.atoms[a].radius * u;
      wrong += inside_planes(s, PatchKind::convex, c, point) != (covered < 0);
    }
  }
  return wrong;
}

// Three atoms leave a gap between their circles on the first one, a few degrees wide; a fourth covers it by a third of
// a square Å where it is deepest, and its own circle lies behind the three all around. None of its arcs is shown: only
// the gap says that its plane is needed.
Balls gap_behind_three(double gap) {
  const double extended = kCarbon + kWater, polar = kPi / 3, cap = polar - gap;
  Balls balls{{{0, 0, 0}, kCarbon}};
  const double distance = 2 * extended * std::cos(cap);
  for (int n = 0; n < 3; ++n) {
    const double turn = 2 * kPi * n / 3;
    balls.push_back(
        {distance * glm::dvec3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)),
         kCarbon});
  }
  const double cover = 2.6 * gap, across = extended * std::sin(cover), small = 1.0 + kWater;
  balls.push_back({{0, 0, extended * std::cos(cover) + std::sqrt(small * small - across * across)}, 1.0});
  return balls;
}

TEST(Trim, AShallowCoverIsNoneTheLess) {
  for (const double degrees : {3.0, 2.0, 1.0, 0.3, 0.1}) {
    SCOPED_TRACE(degrees);
    const Balls balls = gap_behind_three(degrees * kPi / 180);
    const double covered = depth(balls, 0, {0, 0, 1}, kWater);
    ASSERT_GT(covered, 1e-5);
    ASSERT_LT(covered, 0.5);
    const Surface s = compute_surface_cpu(balls, kWater);
    ASSERT_EQ(s.convex[0].atom, 0u);
    EXPECT_FALSE(inside_planes(s, PatchKind::convex, 0, {0, 0, kCarbon})) << "the gap is covered";
    EXPECT_EQ(wrong_directions(s, directions(3000)), 0);
  }
}

TEST(Trim, PlanesLeaveWhatAProbeCanTouch) {
  const auto all = directions(400);
  for (std::uint32_t n = 0; n < 60; ++n) {
    const GasCase gas = gas_case(n);
    EXPECT_EQ(wrong_directions(compute_surface_cpu(gas.balls, gas.probe_radius), all), 0) << "gas " << n;
  }
  EXPECT_EQ(wrong_directions(compute_surface_cpu(ubiquitin(), kWater), all), 0);
}

/// Returns a square of atoms, one of them moved outwards: the probe over all four becomes two, which touch three each.
Balls opened_square(double by) {
  Balls square = ring(4, 3.0);
  square[0].center += by * glm::normalize(square[0].center);
  return square;
}

double least_distance_of_probes(const Surface& s) {
  double least = 1e300;
  for (std::size_t n = 0; n < s.concave.size(); ++n)
    for (std::size_t m = 0; m < n; ++m)
      least = std::min(least, glm::distance(s.concave[n].center, s.concave[m].center));
  return least;
}

TEST(Merging, IsOfProbesWithinAMillionthOfAnAngstrom) {
  const double apart = least_distance_of_probes(compute_surface_cpu(opened_square(1e-4), kWater)) / 1e-4;
  ASSERT_GT(apart, 0.1);
  ASSERT_LT(apart, 10);
  for (const double distance : {1e-4, 1e-5, 5e-6, 2e-6, 1.2e-6}) {
    const Surface s = compute_surface_cpu(opened_square(distance / apart), kWater);
    EXPECT_EQ(s.counts().fixed_probes, 4u) << distance;
    EXPECT_EQ(s.counts().arcs, 6u) << distance;
    EXPECT_NEAR(least_distance_of_probes(s), distance, 0.05 * distance);
  }
  for (const double distance : {8e-7, 1e-7, 0.0}) {
    const Surface s = compute_surface_cpu(opened_square(distance / apart), kWater);
    EXPECT_EQ(s.counts().fixed_probes, 2u) << distance;
    EXPECT_EQ(s.counts().arcs, 4u) << distance;
  }
}

// Deferred planes equal those that were listed at once, to the bit and in the same order.
TEST(Trim, DeferredPlanesAreThose) {
  const auto engine = make_cpu_engine();
  StageClock unused;
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Balls balls = gas(seed, 400, 25, 1.2, 2.0);
    const Surface listed = compute_surface(*engine, balls, kWater, unused);
    Surface deferred = compute_surface(*engine, balls, kWater, unused, ClipPlanes::deferred);
    EXPECT_EQ(deferred.area, listed.area);
    EXPECT_LT(deferred.planes.size(), listed.planes.size());
    for (int calls = 0; calls < 2; ++calls) {
      list_convex_planes(deferred);
      EXPECT_EQ(deferred.reduced, nullptr);
      ASSERT_EQ(deferred.planes.size(), listed.planes.size());
      for (std::size_t n = 0; n < listed.planes.size(); ++n) {
        EXPECT_EQ(deferred.planes[n].normal, listed.planes[n].normal);
        EXPECT_EQ(deferred.planes[n].offset, listed.planes[n].offset);
      }
      ASSERT_EQ(deferred.convex.size(), listed.convex.size());
      for (std::size_t n = 0; n < listed.convex.size(); ++n) {
        EXPECT_EQ(deferred.convex[n].first_plane, listed.convex[n].first_plane);
        EXPECT_EQ(deferred.convex[n].plane_count, listed.convex[n].plane_count);
      }
    }
  }
}

// What needs no planes is the same without them, whatever the certificate says; the few that it asks for are found.
TEST(Trim, NumbersNeedNoPlanes) {
  std::vector<Balls> cases{gap_behind_three(2 * kPi / 180)};
  for (const unsigned seed : {1u, 2u, 3u}) cases.push_back(gas(seed, 400, 25, 1.2, 2.0));
  for (const Balls& balls : cases) {
    const ReducedSurface rs = enumerate_reduced_surface(balls, kWater);
    const Surface drawn = assemble_surface(balls, kWater, rs);
    const Surface numbers = assemble_surface(balls, kWater, rs, nullptr, nullptr, ClipPlanes::left_out);
    EXPECT_EQ(numbers.certificate.closed, drawn.certificate.closed);
    EXPECT_EQ(numbers.certificate.open_atoms, drawn.certificate.open_atoms);
    EXPECT_EQ(numbers.area, drawn.area);
    EXPECT_EQ(numbers.volume, drawn.volume);
    ASSERT_EQ(numbers.faces.size(), drawn.faces.size());
    for (std::size_t f = 0; f < drawn.faces.size(); ++f) EXPECT_EQ(numbers.faces[f].area, drawn.faces[f].area);
    EXPECT_LT(numbers.planes.size(), drawn.planes.size());
    for (const ConvexPatch& patch : numbers.convex) EXPECT_EQ(patch.plane_count, 0u);
  }
}

}  // namespace
}  // namespace meniscus::testing
