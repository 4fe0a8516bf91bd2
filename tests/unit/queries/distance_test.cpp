// SPDX-License-Identifier: BSD-3-Clause
// Distances to the surface in closed form, and against the oracle that knows only the balls.
#include "core/queries/distance.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "tests/support/sanitized.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus {
namespace {

glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

TEST(SurfaceDistance, OfOneBallIsThatToItsSphere) {
  for (const double probe_radius : {0.0, 1.4}) {
    const Surface surface = compute_surface_cpu(testing::Balls{{{1.0, 2.0, 3.0}, 1.7}}, probe_radius);
    const SurfaceDistance distance(surface);
    std::mt19937 random(1);
    for (const double from_center : {0.0, 1e-9, 0.5, 1.7, 1.8, 3.1, 40.0}) {
      const glm::dvec3 center(1.0, 2.0, 3.0), point = center + from_center * random_direction(random);
      const NearestPoint nearest = distance(point);
      EXPECT_NEAR(nearest.distance, from_center - 1.7, 1e-14);
      EXPECT_NEAR(glm::distance(nearest.point, center), 1.7, 1e-14);
      EXPECT_NEAR(glm::distance(nearest.point, point), std::abs(from_center - 1.7), 1e-14);
    }
  }
}

// In the plane half-way between two balls: the probe goes round on a circle of radius T about the axis, on which the
// neck has the radius T - p.
TEST(SurfaceDistance, OfTwoBallsIsThatToTheNeck) {
  const double r = testing::kCarbon, p = testing::kWater, d = 4.0, T = std::sqrt((r + p) * (r + p) - d * d / 4);
  const Surface surface = compute_surface_cpu(testing::two_atoms(d), p);
  const SurfaceDistance distance(surface);
  const double middle = 0.5 * (surface.atoms[0].center.x + surface.atoms[1].center.x);
  for (const double away : {0.0, 0.3, T - p, T - p + 0.5, T, T + p, 10.0}) {
    const NearestPoint nearest = distance({middle, away, 0.0});
    EXPECT_GT(T - p, 0.0);
    if (away <= T) {
      EXPECT_NEAR(nearest.distance, away - (T - p), 1e-14) << away;
    }
    EXPECT_NEAR(nearest.point.x, middle, away <= T - p + 0.5 ? 1e-12 : d) << away;
  }
  // Beyond the circle both contact circles are nearest, and far away the balls themselves.
  EXPECT_NEAR(distance({middle, 10.0, 0.0}).distance, std::hypot(10.0, d / 2) - r, 1e-12);
  EXPECT_NEAR(distance({middle + d / 2 + 5.0, 0.0, 0.0}).distance, 5.0 - r, 1e-14);
}

// A probe that touches its own torus' axis leaves two cusps there.
TEST(SurfaceDistance, OfASpindleIsThatToItsTip) {
  const double r = testing::kCarbon, p = testing::kWater, d = 5.8, half = d / 2;
  const double T = std::sqrt((r + p) * (r + p) - half * half), tip = std::sqrt(p * p - T * T);
  ASSERT_LT(T, p);
  const Surface surface = compute_surface_cpu(testing::two_atoms(d), p);
  const SurfaceDistance distance(surface);
  const double middle = 0.5 * (surface.atoms[0].center.x + surface.atoms[1].center.x);
  EXPECT_NEAR(distance({middle, 0.0, 0.0}).distance, tip, 1e-14);
  EXPECT_NEAR(distance({middle + 0.5 * tip, 0.0, 0.0}).distance, 0.5 * tip, 1e-14);
  EXPECT_LT(distance({middle + 1.5 * tip, 0.0, 0.0}).distance, 0.0);
}

/// Returns points for which many points of a surface are equally near but for rounding: centres of atoms, of probes, of
/// tori and of borders, points of their axes, vertices with the tips of spindles, and midpoints between two such.
std::vector<glm::dvec3> symmetric_points(const Surface& s) {
  std::vector<glm::dvec3> points;
  for (const Ball& atom : s.atoms) points.push_back(atom.center);
  for (const ConcavePatch& patch : s.concave) points.push_back(patch.center);
  const auto add_axis = [&](const glm::dvec3& center, const glm::dvec3& axis) {
    for (const double along : {0.0, 0.4, -1.1, 30.0}) points.push_back(center + along * axis);
  };
  for (const ToroidalPatch& patch : s.toroidal) {
    add_axis(patch.center, patch.axis);
    points.push_back(0.5 * (s.atoms[patch.atom[0]].center + s.atoms[patch.atom[1]].center));
    points.push_back(patch.center + patch.radius * patch.start);
  }
  for (const Border& border : s.borders) add_axis(border.center, border.axis);
  points.insert(points.end(), s.vertices.begin(), s.vertices.end());
  for (std::size_t n = 1; n < s.concave.size(); ++n)
    points.push_back(0.5 * (s.concave[n - 1].center + s.concave[n].center));
  return points;
}

/// Checks that the surface is within a limit exactly if its distance is at most the limit.
void expect_within(const SurfaceDistance& distance, const glm::dvec3& point) {
  const double far = std::abs(distance(point).distance);
  for (const double limit : {0.01, 0.1, 0.5, 2.0, far, far * (1 - 1e-12), far * (1 + 1e-12), far + 1.0})
    if (limit > 0.0) {
      EXPECT_EQ(distance.is_within(point, limit), far <= limit) << far << " and " << limit;
    }
}

/// Checks that every foot is on the surface and as far away as the distance says, at these points and next to them.
void expect_feet_on(const Surface& surface, const std::vector<glm::dvec3>& points) {
  const double p = surface.probe_radius;
  const SurfaceDistance distance(surface);
  const testing::SphereTracer oracle(surface.atoms, p, 0.5);
  std::mt19937 random(3);
  int off = 0, elsewhere = 0;
  for (const glm::dvec3& symmetric : points)
    for (const double aside : {0.0, 1e-15, 1e-9}) {
      const glm::dvec3 point = symmetric + aside * random_direction(random);
      const NearestPoint nearest = distance(point);
      const double height = p > 0 ? oracle.nearest(nearest.point).distance - p : oracle.outside(nearest.point);
      off += !(std::abs(height) < 1e-11);
      elsewhere += !(std::abs(glm::distance(nearest.point, point) - std::abs(nearest.distance)) < 1e-12);
      expect_within(distance, point);
    }
  EXPECT_EQ(off, 0) << "of " << 3 * points.size() << " feet are off the surface";
  EXPECT_EQ(elsewhere, 0) << "of " << 3 * points.size() << " feet are not as far as the distance says";
}

TEST(SurfaceDistance, OfSymmetricPointsHasFeetOnTheSurface) {
  for (const double probe_radius : {0.0, 1.4, 3.0}) {
    SCOPED_TRACE(probe_radius);
    testing::Balls atoms = testing::ubiquitin();
    atoms.resize(static_cast<std::size_t>(test::samples(300)));
    const Surface surface = compute_surface_cpu(atoms, probe_radius);
    expect_feet_on(surface, symmetric_points(surface));
  }
}

// Atoms are turned, so that no axis is one of space: coordinates along them are rounded.
TEST(SurfaceDistance, OfAFewBallsHasFeetOnTheSurface) {
  const double r = testing::kCarbon, p = testing::kWater;
  std::mt19937 random(9);
  for (const testing::Balls& atoms :
       {testing::two_atoms(3.0), testing::two_atoms(4.0, 1.2, 2.0), testing::two_atoms(5.8),
        testing::two_atoms(2 * std::sqrt((r + p) * (r + p) - p * p)), testing::ring(3, 3.0), testing::ring(3, 5.0),
        testing::collinear(3, 2.9), testing::tetrahedron(3.5)})
    for (int turn = 0; turn < 4; ++turn) {
      SCOPED_TRACE(atoms.size());
      const testing::Balls turned =
          testing::translated(testing::rotated(atoms, testing::random_rotation(random)), {11.0, -37.0, 53.0});
      const Surface surface = compute_surface_cpu(turned, p);
      expect_feet_on(surface, symmetric_points(surface));
    }
}

// An atom's centre is equally far from all of its contact patch.
TEST(SurfaceDistance, FromACenterIsTheRadius) {
  const testing::Balls atoms = testing::ubiquitin();
  const Surface surface = compute_surface_cpu(atoms, 1.4);
  const SurfaceDistance distance(surface);
  for (const ConvexPatch& patch : surface.convex) {
    const Ball& atom = surface.atoms[patch.atom];
    const NearestPoint nearest = distance(atom.center);
    EXPECT_NEAR(nearest.distance, -atom.radius, 1e-12);
    EXPECT_NEAR(glm::distance(nearest.point, atom.center), atom.radius, 1e-12);
  }
}

TEST(SurfaceDistance, FromFarAwayIsFinite) {
  const Surface surface = compute_surface_cpu(testing::tetrahedron(3.5), 1.4);
  const SurfaceDistance distance(surface);
  for (const double far : {1e6, 1e16, 1e38, SurfaceDistance::kFarthest})
    for (const glm::dvec3& direction : {glm::dvec3(1, 0, 0), glm::dvec3(1, -1, 1)}) {
      const glm::dvec3 point = far * direction;
      const NearestPoint nearest = distance(point);
      EXPECT_NEAR(nearest.distance / glm::length(point), 1.0, 1e-5);
      EXPECT_NEAR(glm::distance(point, nearest.point) / nearest.distance, 1.0, 1e-15);
      EXPECT_LT(glm::length(nearest.point), 10.0);
    }
}

/// What a distance must satisfy: its point is on the surface and that far away, and no part of the surface is nearer,
/// for within the distance everything is on the point's own side.
struct Tally {
  int solid = 0, solvent = 0, accessible = 0;
};

Tally check(const testing::Balls& atoms, const testing::SphereTracer& oracle, double probe_radius, double tolerance,
            int count, double spread, std::uint32_t seed) {
  const Surface surface = compute_surface_cpu(atoms, probe_radius);
  const SurfaceDistance distance(surface);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-spread, spread);
  Tally tally;
  for (int n = 0; n < count; ++n) {
    // One after another, for arguments are evaluated in an order of the compiler's.
    const glm::dvec3 middle = atoms[random() % atoms.size()].center;
    const double x = offset(random), y = offset(random), z = offset(random);
    const glm::dvec3 point = middle + glm::dvec3(x, y, z);
    const NearestPoint nearest = distance(point);
    expect_within(distance, point);
    const double to_probe = oracle.nearest(point).distance, far = std::abs(nearest.distance);
    EXPECT_NEAR(glm::distance(nearest.point, point), far, 1e-9);
    EXPECT_NEAR(oracle.nearest(nearest.point).distance, probe_radius, tolerance);
    if (std::abs(to_probe - probe_radius) > tolerance) {
      EXPECT_EQ(nearest.distance > 0.0, to_probe < probe_radius) << to_probe;
    }
    if (nearest.distance < 0.0 && to_probe < oracle.reach()) {
      EXPECT_NEAR(nearest.distance, probe_radius - to_probe, tolerance);
    }
    const double within = far * (1 - 1e-6) - 1e-6;
    for (int k = 0; k < 30 && within > 0.0; ++k) {
      const double there = oracle.nearest(point + within * random_direction(random)).distance;
      EXPECT_EQ(there<probe_radius, nearest.distance> 0.0) << n << ": something is nearer than " << far;
    }
    tally.solid += nearest.distance < 0.0;
    tally.solvent += nearest.distance > 0.0;
    tally.accessible += to_probe == 0.0;
  }
  return tally;
}

TEST(SurfaceDistance, OfAProteinIsWhatTheOracleSays) {
  for (const double probe_radius : {0.7, 1.4, 3.0}) {
    const testing::Balls atoms = testing::ubiquitin();
    const testing::SphereTracer oracle(atoms, probe_radius, 1.0);
    const Tally tally = check(atoms, oracle, probe_radius, 1e-11, 400, 6.0, 7);
    EXPECT_GT(tally.solid, 50);
    EXPECT_GT(tally.solvent, 50);
    EXPECT_GT(tally.accessible, 20);
  }
}

// Touching counts as overlapping: balls between which a probe just fits have no room for it. So the oracle's grow.
TEST(SurfaceDistance, OfDegenerateMoleculesIsWhatTheOracleSays) {
  for (const testing::NamedBalls& molecule : testing::degenerate_molecules()) {
    SCOPED_TRACE(molecule.name);
    if (molecule.probe_radius == 0.0) continue;
    testing::Balls grown = molecule.balls;
    for (Ball& ball : grown) ball.radius += 5e-9;
    const testing::SphereTracer oracle(grown, molecule.probe_radius, 1.0);
    check(molecule.balls, oracle, molecule.probe_radius, 1e-6, 25, 4.0, 11);
  }
}

// Without a probe the solid is the union of the balls, and the distance in it that to what is left of their spheres.
TEST(SurfaceDistance, OfBallsWithoutAProbe) {
  const testing::Balls atoms = testing::ubiquitin();
  const Surface surface = compute_surface_cpu(atoms, 0.0);
  const SurfaceDistance distance(surface);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> offset(-4.0, 4.0);
  int solid = 0;
  for (int n = 0; n < 400; ++n) {
    const glm::dvec3 point =
        atoms[random() % atoms.size()].center + glm::dvec3(offset(random), offset(random), offset(random));
    double outside = 1e9;
    for (const Ball& atom : atoms) outside = std::min(outside, glm::distance(point, atom.center) - atom.radius);
    const double found = distance(point).distance;
    if (outside > 0.0) {
      EXPECT_NEAR(found, outside, 1e-9);
    } else {
      EXPECT_LE(found, outside + 1e-9);  // The point is at least as deep as in one ball.
    }
    solid += outside < 0.0;
  }
  EXPECT_GT(solid, 50);
}

}  // namespace
}  // namespace meniscus
