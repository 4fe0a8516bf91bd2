// SPDX-License-Identifier: BSD-3-Clause
// Numbers that cannot be are refused: each fault that a surface could hide behind closed borders is planted and found.
#include "core/surface/certificate.h"

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/surface/component_side.h"
#include "core/surface/surface.h"
#include "core/surface/tie_ladder.h"
#include "exporters/mesh/compare_mesh.h"
#include "exporters/mesh/tessellate.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

constexpr double kPi = std::numbers::pi;

bool holds(Surface surface, const MeasurementDoubts& doubts = {}) {
  surface.certificate = {};
  certify(surface, doubts);
  return surface.certificate.closed;
}

// With a cavity: a lattice whose cells have room for the probe.
Surface lattice_with_cavities() { return compute_surface_cpu(lattice(3, 3, 3, 3.8), kWater); }

Face& first_face(Surface& surface, PatchKind kind) {
  for (Face& face : surface.faces)
    if (face.kind == kind) return face;
  ADD_FAILURE() << "no such face";
  return surface.faces.front();
}

TEST(Certificate, HoldsForWhatItShould) {
  EXPECT_TRUE(holds(lattice_with_cavities()));
  for (const NamedBalls& molecule : degenerate_molecules())
    EXPECT_TRUE(holds(compute_surface_cpu(molecule.balls, molecule.probe_radius))) << molecule.name;
}

TEST(Certificate, FindsAFaceThatIsOffByASphere) {
  for (const PatchKind kind : {PatchKind::convex, PatchKind::concave})
    for (const double sign : {1.0, -1.0}) {
      Surface surface = lattice_with_cavities();
      const double radius = kind == PatchKind::convex ? kCarbon : kWater;
      first_face(surface, kind).area += sign * 4 * kPi * radius * radius;
      EXPECT_FALSE(holds(surface)) << int(kind) << ' ' << sign;
    }
}

TEST(Certificate, FindsAFaceWithoutANumber) {
  for (const PatchKind kind : {PatchKind::convex, PatchKind::toroidal, PatchKind::concave}) {
    Surface surface = lattice_with_cavities();
    first_face(surface, kind).area = std::nan("");
    EXPECT_FALSE(holds(surface)) << int(kind);
  }
}

TEST(Certificate, FindsAComponentOnTheWrongSide) {
  const Surface surface = lattice_with_cavities();
  ASSERT_GT(surface.components.size(), 1u);
  for (std::size_t c = 0; c < surface.components.size(); ++c) {
    Surface flipped = surface;
    Component& component = flipped.components[c];
    component.kind = component.kind == ComponentKind::outer ? ComponentKind::cavity : ComponentKind::outer;
    EXPECT_FALSE(holds(flipped)) << c;
    Surface negated = surface;
    negated.components[c].volume *= -1;
    EXPECT_FALSE(holds(negated)) << c;
  }
}

TEST(Certificate, FindsAnOddEulerNumberAndOneAboveTwo) {
  for (const int euler : {1, 3, 4, -7}) {
    Surface surface = lattice_with_cavities();
    surface.components[0].euler = euler;
    EXPECT_FALSE(holds(surface)) << euler;
  }
}

// A lone atom shows everything; a plane that covers most of it contradicts.
TEST(Certificate, FindsPlanesThatContradictTheFaces) {
  Surface surface = compute_surface_cpu(Balls{{{0, 0, 0}, 1.7}}, kWater);
  EXPECT_TRUE(holds(surface));
  surface.convex[0].first_plane = static_cast<std::uint32_t>(surface.planes.size());
  surface.convex[0].plane_count = 1;
  surface.planes.push_back({{0, 0, 1}, -1.0});
  EXPECT_FALSE(holds(surface));
}

TEST(Certificate, NamesDisputedFaces) {
  EXPECT_FALSE(holds(lattice_with_cavities(), {{0}, {0}}));
  EXPECT_TRUE(holds(lattice_with_cavities(), {{0}, {}}));
}

// The volume's sign is an independent answer where both are sure.
TEST(SideOfComponents, AgreesWithTheSignOfTheVolume) {
  std::mt19937 random(3);
  std::size_t cavities = 0;
  const auto expect_agreement = [&](const Surface& surface) {
    const std::vector<ComponentKind> sides = side_of_components(surface);
    ASSERT_EQ(sides.size(), surface.components.size());
    for (std::size_t c = 0; c < sides.size(); ++c) {
      if (std::abs(surface.components[c].volume) < 1e-6) continue;
      EXPECT_EQ(sides[c] == ComponentKind::cavity, surface.components[c].volume < 0);
      cavities += sides[c] == ComponentKind::cavity;
    }
  };
  for (const NamedBalls& molecule : degenerate_molecules())
    expect_agreement(compute_surface_cpu(rotated(molecule.balls, random_rotation(random)), molecule.probe_radius));
  for (std::uint32_t n = 0; n < 200; ++n) {
    const GasCase gas = gas_case(n);
    expect_agreement(compute_surface_cpu(gas.balls, gas.probe_radius));
  }
  for (const double probe : {0.0, 0.4, 1.4}) expect_agreement(compute_surface_cpu(enterotoxin(), probe));
  EXPECT_GT(cavities, 50u);
}

TEST(TieLadder, GrowsOnlyWhatDoesNotClose) {
  const Balls balls = ubiquitin();
  int attempts = 0;
  const auto closing_at = [&](int attempt) {
    return [&, attempt](std::span<const Ball> grown) {
      Surface surface;
      surface.atoms.assign(grown.begin(), grown.end());
      surface.certificate.closed = attempts++ == attempt;
      return surface;
    };
  };
  const Surface first = compute_through_ties(balls, closing_at(0));
  EXPECT_EQ(attempts, 1);
  EXPECT_EQ(first.certificate.grown_by, 0.0);
  EXPECT_EQ(first.atoms[5].radius, balls[5].radius);
  attempts = 0;
  const Surface third = compute_through_ties(balls, closing_at(2));
  EXPECT_EQ(attempts, 3);
  EXPECT_EQ(third.certificate.grown_by, tie_growth(2));
  for (std::size_t a = 0; a < balls.size(); ++a) {
    EXPECT_GE(third.atoms[a].radius - balls[a].radius, 0.499 * tie_growth(2));
    EXPECT_LE(third.atoms[a].radius - balls[a].radius, 1.001 * tie_growth(2));
    EXPECT_EQ(third.atoms[a].center, balls[a].center);
  }
  EXPECT_NE(third.atoms[0].radius - balls[0].radius, third.atoms[1].radius - balls[1].radius);
  attempts = 0;
  EXPECT_FALSE(compute_through_ties(balls, closing_at(-1)).certificate.closed);
  EXPECT_EQ(attempts, kTieAttempts);
}

// What --verify compares: a face off by a sphere, a component by a probe, an area that is none.
TEST(CompareMesh, FindsWhatTrianglesContradict) {
  const Surface surface = compute_surface_cpu(lattice(3, 3, 3, 3.8), kWater);
  const TriangleMesh mesh = tessellate(surface, {0.1, false});
  EXPECT_TRUE(differences(surface, mesh).empty());
  for (const PatchKind kind : {PatchKind::convex, PatchKind::concave}) {
    Surface wrong = surface;
    first_face(wrong, kind).area += 4 * kPi * kWater * kWater;
    EXPECT_EQ(differences(wrong, mesh).size(), 1u);
  }
  Surface wrong = surface;
  wrong.components.back().volume = -wrong.components.back().volume;
  EXPECT_EQ(differences(wrong, mesh).size(), 1u);
  wrong.faces[0].area = std::nan("");
  EXPECT_EQ(differences(wrong, mesh).size(), 2u);
}

}  // namespace
}  // namespace meniscus::testing
