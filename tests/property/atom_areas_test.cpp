// SPDX-License-Identifier: BSD-3-Clause
// Areas of atoms: closed forms, sums, random points, and changes that must not matter.
#include "core/surface/measure.h"

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "tests/support/patch_samples.h"
#include "tests/support/sanitized.h"

namespace meniscus::testing {
namespace {

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

void expect_sum(const Surface& surface) {
  const AtomAreas areas = atom_areas(surface);
  ASSERT_EQ(areas.surface.size(), surface.atoms.size());
  EXPECT_NEAR(sum(areas.surface), surface.area, 1e-12 * surface.area);
  for (const double area : areas.surface) EXPECT_GE(area, -1e-12 * surface.area);
}

TEST(AtomAreas, TwoSpheresOfDifferentSize) {
  const double ra = 1.9, rb = 1.2;
  for (const double p : {0.4, 1.4, 3.0})
    for (double d = 1.0; d < ra + rb + 2 * p; d += 0.07) {
      const Surface s = compute_surface_cpu(two_atoms(d, ra, rb), p);
      if (s.toroidal.empty() || s.counts().convex < 2) continue;
      const AtomAreas areas = atom_areas(s);
      const double a = ra + p, b = rb + p;                      // extended radii
      const double height = (d * d + a * a - b * b) / (2 * d);  // height of the circle over the first centre
      const double circle = std::sqrt(a * a - height * height);
      const double low = std::atan2(-height, circle), high = std::atan2(d - height, circle),
                   middle = 0.5 * (low + high);
      const double tip = circle < p && low < 0 && high > 0 ? std::acos(circle / p) : 0.0;
      // Returns the area of the torus between two tube angles, without the part past the axis.
      const auto torus = [&](double from, double to) {
        double area = 0;
        for (const auto& [left, right] : {std::pair{low, -tip}, {tip, high}}) {
          const double x = std::max(from, left), y = std::min(to, right);
          if (x < y) area += 2 * kPi * p * (circle * (y - x) - p * (std::sin(y) - std::sin(x)));
        }
        return area;
      };
      const double cap_a = 2 * kPi * (1 + height / a),
                   cap_b = 2 * kPi * (1 + (d - height) / b);  // solid angles of the caps
      EXPECT_NEAR(areas.surface[0], cap_a * ra * ra + torus(low, middle), 1e-9) << "d = " << d << ", p = " << p;
      EXPECT_NEAR(areas.surface[1], cap_b * rb * rb + torus(middle, high), 1e-9) << "d = " << d << ", p = " << p;
      EXPECT_NEAR(areas.accessible[0], cap_a * a * a, 1e-9);
      EXPECT_NEAR(areas.accessible[1], cap_b * b * b, 1e-9);
    }
}

TEST(AtomAreas, SumUpToTheWholeSurface) {
  expect_sum(compute_surface_cpu(ubiquitin(), kWater));
  expect_sum(compute_surface_cpu(enterotoxin(), kWater));
  for (const NamedBalls& molecule : degenerate_molecules()) {
    SCOPED_TRACE(molecule.name);
    expect_sum(compute_surface_cpu(molecule.balls, molecule.probe_radius));
  }
  for (std::uint32_t n = 0; n < 100; ++n) {
    SCOPED_TRACE("gas " + std::to_string(n));
    const GasCase gas = gas_case(n);
    expect_sum(compute_surface_cpu(gas.balls, gas.probe_radius));
  }
}

TEST(AtomAreas, OfGroupsAreTheSumsOfTheirAtoms) {
  for (const std::uint32_t count : {1u, 2u, 7u}) {
    const Surface surface = compute_surface_cpu(gas(count, 400, 25, 1.2, 2.0), kWater);
    std::vector<std::uint32_t> group_of(surface.atoms.size());
    for (std::uint32_t a = 0; a < group_of.size(); ++a) group_of[a] = a % 50 * count / 50;
    const AtomAreas atoms = atom_areas(surface), groups = group_areas(surface, group_of, count);
    ASSERT_EQ(groups.surface.size(), count);
    for (std::uint32_t g = 0; g < count; ++g) {
      double area = 0.0, accessible = 0.0;
      for (std::size_t a = 0; a < group_of.size(); ++a) {
        area += group_of[a] == g ? atoms.surface[a] : 0.0;
        accessible += group_of[a] == g ? atoms.accessible[a] : 0.0;
      }
      EXPECT_NEAR(groups.surface[g], area, 1e-9 * surface.area) << g << " of " << count;
      EXPECT_NEAR(groups.accessible[g], accessible, 1e-9 * surface.area) << g << " of " << count;
    }
  }
}

TEST(AtomAreas, ThatDoNotAddUpAreRefused) {
  Surface s = compute_surface_cpu(ubiquitin(), 1.4);
  s.area *= 1 + 1e-5;
  EXPECT_THROW(atom_areas(s), OpenSurfaceError);
  s = compute_surface_cpu(ubiquitin(), 1.4);
  s.faces[s.convex[3].first_face].area -= 100;
  s.area -= 100;
  EXPECT_THROW(atom_areas(s), OpenSurfaceError) << "an atom has a negative area";
}

TEST(AtomAreas, AccessibleAreaIsThatOfTheUnionOfGrownBalls) {
  for (const double p : {0.7, 1.4, 2.5}) {
    const Surface ses = compute_surface_cpu(ubiquitin(), p);
    Balls grown = ubiquitin();
    for (Ball& ball : grown) ball.radius += p;
    const Surface sas = compute_surface_cpu(grown, 0.0);
    const AtomAreas of_ses = atom_areas(ses), of_sas = atom_areas(sas);
    EXPECT_NEAR(sum(of_ses.accessible), sas.area, 1e-9 * sas.area);
    for (std::size_t n = 0; n < grown.size(); ++n) EXPECT_NEAR(of_ses.accessible[n], of_sas.surface[n], 1e-9);
  }
}

TEST(AtomAreas, AccessibleAreaOfBallsThatAreTinyBesideTheProbeIsExact) {
  for (const double radius : {1e-2, 1e-4, 1e-6}) {
    SCOPED_TRACE(radius);
    Balls balls = ubiquitin();
    for (std::size_t n = 0; n < balls.size(); ++n) balls[n].radius = n % 3 ? radius : 1.7;
    const Surface ses = compute_surface_cpu(balls, kWater);
    for (Ball& ball : balls) ball.radius += kWater;
    const Surface sas = compute_surface_cpu(balls, 0.0);
    const AtomAreas of_ses = atom_areas(ses), of_sas = atom_areas(sas);
    EXPECT_NEAR(accessible_area(ses), sas.area, 1e-12 * sas.area);
    for (std::size_t n = 0; n < balls.size(); ++n) EXPECT_NEAR(of_ses.accessible[n], of_sas.surface[n], 1e-11);
  }
}

// Returns the atom whose contact direction is nearest to a point of a re-entrant patch, by its definition.
std::uint32_t owner(const Surface& s, const ConcavePatch& patch, const glm::dvec3& point) {
  std::uint32_t best = 0;
  double nearest = -2;
  for (std::uint32_t n = 0; n < patch.contact_count; ++n) {
    const std::uint32_t atom = s.contacts[patch.first_contact + n];
    const double cosine = glm::dot(glm::normalize(s.atoms[atom].center - patch.center), point - patch.center);
    if (n == 0 || cosine > nearest) {
      nearest = cosine;
      best = atom;
    }
  }
  return best;
}

std::uint32_t owner(const Surface& s, const ToroidalPatch& patch, const glm::dvec3& point) {
  const glm::dvec3 v = point - patch.center, across = v - patch.axis * glm::dot(v, patch.axis);
  const glm::dvec3 probe = patch.center + patch.radius * glm::normalize(across);
  const auto cosine = [&](std::uint32_t atom) {
    return glm::dot(glm::normalize(s.atoms[atom].center - probe), point - probe);
  };
  return cosine(patch.atom[0]) > cosine(patch.atom[1]) ? patch.atom[0] : patch.atom[1];
}

// Counts random points of every patch for their owners.
void expect_sampled(const Surface& s, int samples, std::mt19937& random) {
  std::vector<double> area(s.atoms.size(), 0.0), variance(s.atoms.size(), 0.0);
  for (const PatchKind kind : {PatchKind::convex, PatchKind::toroidal, PatchKind::concave})
    for (std::uint32_t patch = 0; patch < patch_count(s, kind); ++patch) {
      const double weight = whole_area(s, kind, patch) / samples;
      for (int n = 0; n < samples; ++n) {
        const PatchSample sample = sample_patch(s, kind, patch, random);
        if (!sample.inside) continue;
        const std::uint32_t atom = kind == PatchKind::convex     ? s.convex[patch].atom
                                   : kind == PatchKind::toroidal ? owner(s, s.toroidal[patch], sample.point)
                                                                 : owner(s, s.concave[patch], sample.point);
        area[atom] += weight;
        variance[atom] += weight * weight;
      }
    }
  const AtomAreas exact = atom_areas(s);
  for (std::size_t n = 0; n < area.size(); ++n)
    EXPECT_NEAR(exact.surface[n], area[n], 6 * std::sqrt(variance[n]) + 20.0 / samples) << "atom " << n;
}

TEST(AtomAreas, RandomPointsOfEveryPatchAgree) {
  std::mt19937 random(11);
  expect_sampled(compute_surface_cpu(ubiquitin(), kWater), test::samples(3000), random);
  for (const NamedBalls& molecule : degenerate_molecules()) {  // probes with four and more contacts
    if (molecule.probe_radius == 0) continue;
    SCOPED_TRACE(molecule.name);
    expect_sampled(compute_surface_cpu(molecule.balls, molecule.probe_radius), test::samples(3000), random);
  }
  for (int n = 0; n < test::samples(30); ++n) {
    const GasCase gas = gas_case(n);
    if (gas.probe_radius == 0) continue;
    SCOPED_TRACE("gas " + std::to_string(n));
    expect_sampled(compute_surface_cpu(gas.balls, gas.probe_radius), 1000, random);
  }
}

TEST(AtomAreas, DoNotDependOnOrientationOrOrder) {
  std::mt19937 random(3);
  const Balls balls = ubiquitin();
  const AtomAreas before = atom_areas(compute_surface_cpu(balls, kWater));
  for (int turn = 0; turn < 3; ++turn) {
    const auto order = random_order(balls.size(), random);
    const AtomAreas after =
        atom_areas(compute_surface_cpu(permuted(rotated(balls, random_rotation(random)), order), kWater));
    for (std::size_t n = 0; n < order.size(); ++n) {
      EXPECT_NEAR(after.surface[n], before.surface[order[n]], 1e-9);
      EXPECT_NEAR(after.accessible[n], before.accessible[order[n]], 1e-9);
    }
  }
}

TEST(AtomAreas, AtomsOfASymmetricCageShareItEqually) {
  for (const Balls& balls : {c60(), octahedron(3.0), icosahedron(3.0)}) {
    const Surface s = compute_surface_cpu(balls, kWater);
    const AtomAreas areas = atom_areas(s);
    for (const double area : areas.surface) EXPECT_NEAR(area, s.area / static_cast<double>(balls.size()), 1e-9);
  }
}

}  // namespace
}  // namespace meniscus::testing
