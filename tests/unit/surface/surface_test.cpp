// SPDX-License-Identifier: BSD-3-Clause
// Surfaces known in closed form or from an independent enumeration: areas, volumes, counts, components.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

double sphere_area(double r) { return 4 * kPi * r * r; }
double sphere_volume(double r) { return 4 * kPi / 3 * r * r * r; }
double ball_cap_volume(double r, double height) { return kPi * height * height * (r - height / 3); }

std::vector<int> euler_numbers(const Surface& surface) {
  std::vector<int> numbers;
  for (const Component& c : surface.components) numbers.push_back(c.euler);
  return numbers;
}

// Returns the area of two spheres of radius r at distance d (docs/explanation/theory.md, theorem 3; Connolly 1983).
double two_sphere_area(double r, double d, double p) {
  const double extended = r + p, circle = std::sqrt(extended * extended - d * d / 4), phi = std::asin(d / 2 / extended);
  const double convex = 4 * kPi * r * r * (1 + std::sin(phi));
  if (circle >= p) return convex + 2 * kPi * p * (2 * phi * circle - 2 * p * std::sin(phi));
  const double q = std::acos(circle / p);
  return convex + 4 * kPi * p * (circle * (phi - q) - p * (std::sin(phi) - std::sin(q)));
}

// Returns the volume of the same solid: turns its outline about the axis and integrates with Simpson's rule.
double two_sphere_volume(double r, double d, double p) {
  const double extended = r + p, half = d / 2, circle = std::sqrt(extended * extended - half * half);
  const double contact = half * p / extended;  // the torus reaches from -contact to contact along the axis
  const double tip = circle < p ? std::sqrt(p * p - circle * circle) : 0;
  const auto slice = [&](double z) {
    const double rho = circle - std::sqrt(p * p - z * z);
    return kPi * rho * rho;
  };
  const int steps = 20000;
  const double h = (contact - tip) / steps;
  double torus = slice(tip) + slice(contact);
  for (int n = 1; n < steps; ++n) torus += slice(tip + n * h) * (n % 2 ? 4 : 2);
  torus *= h / 3;
  const double beyond = r + half - contact;  // height of the ball's cap outside the contact circle
  return 2 * (torus + ball_cap_volume(r, beyond));
}

TEST(TwoSpheres, MatchTheClosedFormAtEveryDistance) {
  for (const double p : {0.3, 1.4, 3.0})
    for (double d = 0.05; d < 2 * (kCarbon + p); d += 0.05) {
      const Surface s = compute_surface_cpu(two_atoms(d), p);
      EXPECT_NEAR(s.area / two_sphere_area(kCarbon, d, p), 1, 1e-9) << "d = " << d << ", p = " << p;
      EXPECT_NEAR(s.volume / two_sphere_volume(kCarbon, d, p), 1, 1e-9) << "d = " << d << ", p = " << p;
      const double circle = std::sqrt(std::pow(kCarbon + p, 2) - d * d / 4);
      const bool spindle = circle < p;
      EXPECT_EQ(s.counts().spindle, spindle ? 1u : 0u);
      EXPECT_EQ(s.counts().free_edges, 1u);
      EXPECT_EQ(euler_numbers(s), spindle ? std::vector<int>({2, 2}) : std::vector<int>({2}));
    }
}

TEST(TwoSpheres, UnionOfBallsForAProbeOfRadiusZero) {
  const double a = 1.7, b = 1.2;
  for (double d = 0.55; d < 2.9; d += 0.1) {
    const Surface s = compute_surface_cpu(two_atoms(d, a, b), 0.0);
    const double height = (d * d + a * a - b * b) / (2 * d);  // height of the circle over the first centre
    const double cap_a = a + height, cap_b = b + (d - height);
    EXPECT_NEAR(s.area, 2 * kPi * (a * cap_a + b * cap_b), 1e-9 * s.area);
    EXPECT_NEAR(s.volume, ball_cap_volume(a, cap_a) + ball_cap_volume(b, cap_b), 1e-9 * s.volume);
  }
}

TEST(TwoSpheres, ANearlySwallowedAtomMakesNoSpindle) {
  // The circle is smaller than the probe, but its centre lies beyond the small atom: the patch keeps off the axis.
  const Balls balls = two_atoms(1.6, 2.6, 1.05);
  const double p = 1.4, big = 4.0, small = 2.45;
  const double height = (1.6 * 1.6 + big * big - small * small) / 3.2;
  ASSERT_GT(height, 1.6);
  ASSERT_LT(big * big - height * height, p * p);
  const Surface s = compute_surface_cpu(balls, p);
  EXPECT_EQ(s.counts().spindle, 0u);
  EXPECT_EQ(euler_numbers(s), std::vector<int>{2});
  // The torus by Pappus: arc length times the way of its centroid, in closed form from the tube angles of the contacts.
  const double circle = std::sqrt(big * big - height * height);
  const double from = std::atan2(-height, circle), to = std::atan2(1.6 - height, circle);
  const double torus = 2 * kPi * p * (circle * (to - from) - p * (std::sin(to) - std::sin(from)));
  const double convex = 2 * kPi * (2.6 * 2.6 * (1 + height / big) + 1.05 * 1.05 * (1 + (1.6 - height) / small));
  EXPECT_NEAR(s.area, torus + convex, 1e-9 * s.area);
}

TEST(TwoSpheres, TouchingSasSpheresAreTwoWholeSpheres) {
  const Surface s = compute_surface_cpu(two_atoms(6.2), 1.4);
  EXPECT_NEAR(s.area, 2 * sphere_area(kCarbon), 1e-6);
  EXPECT_NEAR(s.volume, 2 * sphere_volume(kCarbon), 1e-6);
  EXPECT_EQ(euler_numbers(s), (std::vector<int>{2, 2}));
}

TEST(TwoSpheres, ACircleAsLargeAsTheProbeTouchesItsAxis) {
  // 3-4-5: extended radius 2.5, circle radius 1.5 = p; computed with rounding either way.
  for (const double p : {1.5, std::nextafter(1.5, 0.0), std::nextafter(1.5, 2.0)}) {
    const Surface s = compute_surface_cpu(two_atoms(4.0, 2.5 - p, 2.5 - p), p);
    EXPECT_EQ(s.counts().spindle, 0u);
    EXPECT_EQ(euler_numbers(s), std::vector<int>{2});
  }
}

TEST(Atoms, SingleSphere) {
  for (const double p : {0.0, 1.4, 8.0}) {
    const Surface s = compute_surface_cpu(Balls{{{3, -2, 1}, 1.7}}, p);
    EXPECT_NEAR(s.area, sphere_area(1.7), 1e-12 * s.area);
    EXPECT_NEAR(s.volume, sphere_volume(1.7), 1e-12 * s.volume);
    EXPECT_EQ(euler_numbers(s), std::vector<int>{2});
  }
}

TEST(Atoms, LoneOnesAmongOthersAreWholeSpheres) {
  const Balls pair = two_atoms(3.0);
  const Surface alone = compute_surface_cpu(pair, kWater);
  for (const std::size_t place : {0, 1, 2}) {
    Balls balls = pair;
    balls.insert(balls.begin() + static_cast<std::ptrdiff_t>(place), {{0, 40, 0}, 1.5});
    const Surface s = compute_surface_cpu(balls, kWater);
    EXPECT_EQ(s.counts().convex, 3u);
    EXPECT_EQ(euler_numbers(s), (std::vector<int>{2, 2}));
    EXPECT_NEAR(s.area, alone.area + sphere_area(1.5), 1e-9);
  }
}

TEST(Atoms, NoneIsAnEmptyClosedSurface) {
  const Surface s = compute_surface_cpu({}, 1.4);
  EXPECT_EQ(s.area, 0);
  EXPECT_TRUE(s.components.empty());
}

struct Row {
  NamedBalls molecule;
  double area, volume;
  std::vector<int> euler;  // outer components first
  std::size_t fixed_probes, arcs, free_edges, convex;
};

// Returns areas and volumes of an independent enumeration; counts of n-contact probes by symmetry.
std::vector<Row> reference_rows() {
  const Balls coincident = two_atoms(0.0), nested = {{{0.4, 0.3, -0.2}, 1.0}, {{0, 0, 0}, 3.0}};
  return {{{"two, 3.0", two_atoms(3.0)}, 66.078, 42.347, {2}, 0, 0, 1, 2},
          {{"two, 4.5", two_atoms(4.5)}, 75.270, 43.959, {2}, 0, 0, 1, 2},
          {{"three collinear", collinear(3, 3.0)}, 95.839, 64.114, {2}, 0, 0, 2, 3},
          {{"square", ring(4, 3.0)}, 115.727, 87.571, {2}, 2, 4, 0, 4},
          {{"tetrahedron", tetrahedron(2 * std::sqrt(2.0))}, 102.614, 81.497, {2}, 4, 6, 0, 4},
          {{"far apart", two_atoms(30)}, 72.634, 41.159, {2, 2}, 0, 0, 0, 2},
          {{"nested", nested}, 113.097, 113.097, {2}, 0, 0, 0, 1},
          {{"coincident", coincident}, 36.317, 20.580, {2}, 0, 0, 0, 1},
          {{"c60", c60()}, 389.131, 521.386, {2, 2}, 64, 180, 0, 60},
          {{"lattice", lattice(4, 4, 4, 3.0)}, 841.15, 1578.8, {2}, 54, 108, 0, 56}};
}

TEST(ReferenceTable, DegenerateMolecules) {
  for (const Row& row : reference_rows()) {
    SCOPED_TRACE(row.molecule.name);
    const Surface s = compute_surface_cpu(row.molecule.balls, kWater);
    const double digits = row.area > 800 ? 0.06 : 6e-4;
    EXPECT_NEAR(s.area, row.area, digits);
    EXPECT_NEAR(s.volume, row.volume, std::max(digits, 1e-3));
    EXPECT_EQ(euler_numbers(s), row.euler);
    EXPECT_EQ(s.counts().fixed_probes, row.fixed_probes);
    EXPECT_EQ(s.counts().arcs, row.arcs);
    EXPECT_EQ(s.counts().free_edges, row.free_edges);
    EXPECT_EQ(s.counts().convex, row.convex);
  }
}

TEST(ReferenceTable, C60HasAnInnerCavityAndMergedProbes) {
  const Surface s = compute_surface_cpu(c60(), kWater);
  ASSERT_EQ(s.components.size(), 2u);
  EXPECT_EQ(s.components[0].kind, ComponentKind::outer);
  EXPECT_EQ(s.components[1].kind, ComponentKind::cavity);
  EXPECT_LT(s.components[1].volume, 0);
  std::size_t five = 0, six = 0;
  for (const ConcavePatch& patch : s.concave) {
    five += patch.contact_count == 5;
    six += patch.contact_count == 6;
  }
  EXPECT_EQ(five, 24u);
  EXPECT_EQ(six, 40u);
}

TEST(ReferenceTable, LatticeProbesTouchFourAtoms) {
  const Surface s = compute_surface_cpu(lattice(4, 4, 4, 3.0), kWater);
  for (const ConcavePatch& patch : s.concave) EXPECT_EQ(patch.contact_count, 4u);
}

void expect_protein(const Balls& balls, const SurfaceCounts& counts, std::array<double, 3> kind_area, double area,
                    double area_error, double volume, double volume_error) {
  const Surface s = compute_surface_cpu(balls, kWater);
  EXPECT_EQ(s.counts().fixed_probes, counts.fixed_probes);
  EXPECT_EQ(s.counts().arcs, counts.arcs);
  EXPECT_EQ(s.counts().free_edges, counts.free_edges);
  EXPECT_EQ(s.counts().convex, counts.convex);
  EXPECT_EQ(s.counts().spindle, counts.spindle);
  EXPECT_EQ(2 * s.counts().arcs, 3 * s.counts().fixed_probes);
  std::array<double, 3> sums{};
  for (const Face& face : s.faces) sums[static_cast<int>(face.kind)] += face.area;
  EXPECT_NEAR(sums[0], kind_area[0], 1e-3);
  EXPECT_NEAR(sums[1], kind_area[1], 1e-3);
  EXPECT_NEAR(sums[2], kind_area[2], area_error);
  EXPECT_NEAR(s.area, area, area_error);
  EXPECT_NEAR(s.volume, volume, volume_error);
}

TEST(ReferenceTable, Ubiquitin) {
  const SurfaceCounts counts{.convex = 391, .free_edges = 0, .spindle = 60, .fixed_probes = 860, .arcs = 1290};
  expect_protein(ubiquitin(), counts, {1387.574, 1524.024, 1116.17}, 4027.77, 0.05, 9185.4, 0.06);
}

TEST(ReferenceTable, Enterotoxin) {
  const SurfaceCounts counts{.convex = 3019, .free_edges = 3, .spindle = 634, .fixed_probes = 6460, .arcs = 9690};
  expect_protein(enterotoxin(), counts, {7789.693, 10387.919, 10098.0}, 28275.6, 0.5, 85925.0, 1.0);
}

// Six atoms around a hole that a probe just fits in: the cavity is the probe's own sphere, with convex and toroidal
// patches as thin as the slack.
TEST(Cavity, ThatAProbeBarelyFits) {
  const double fits = (kCarbon + kWater) * std::sqrt(2.0);
  for (double slack = 1e-2; slack > 5e-9; slack /= 10) {
    SCOPED_TRACE(slack);
    const Surface s = compute_surface_cpu(octahedron(fits * (1 + slack)), kWater);
    EXPECT_EQ(euler_numbers(s), (std::vector<int>{2, 2}));
    EXPECT_NEAR(s.components[1].area, sphere_area(kWater), 170 * slack);
    EXPECT_NEAR(s.components[1].volume, -sphere_volume(kWater), 120 * slack);
  }
  EXPECT_EQ(compute_surface_cpu(octahedron(fits * (1 - 1e-8)), kWater).components.size(), 1u);
}

// A surface that is not closed must never come out: a missing arc is reported, with the atoms it belongs to.
TEST(Certificate, AMissingArcIsNoticed) {
  const Balls balls = c60();
  const ReducedSurface whole = enumerate_reduced_surface(balls, kWater);
  for (std::size_t n = 0; n < whole.arcs.size(); n += 7) {
    ReducedSurface damaged = whole;
    damaged.arcs.erase(damaged.arcs.begin() + n);
    const Surface s = assemble_surface(balls, kWater, damaged);
    EXPECT_FALSE(s.certificate.closed);
    EXPECT_FALSE(s.certificate.open_atoms.empty());
    EXPECT_THROW(require_closed(s), OpenSurfaceError);
  }
}

}  // namespace
}  // namespace meniscus::testing
