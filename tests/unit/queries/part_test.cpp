// SPDX-License-Identifier: BSD-3-Clause
// Parts of a surface: closed, with tables that agree with each other; nested components; planes between faces.
#include "core/queries/surface_parts.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/surface/compute_surface.h"
#include "core/surface/measure.h"
#include "core/surface/trim.h"
#include "tests/support/molecules.h"
#include "tests/support/patch_samples.h"

namespace meniscus::testing {
namespace {

// Counts patches with faces in several components.
std::size_t mixed_patches(const Surface& s) {
  std::size_t count = 0;
  const auto look = [&](const auto& patches) {
    for (const auto& patch : patches) {
      bool mixed = false;
      for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f)
        mixed = mixed || s.faces[f].component != s.faces[patch.first_face].component;
      count += mixed;
    }
  };
  look(s.convex);
  look(s.toroidal);
  look(s.concave);
  return count;
}

// Checks that every border has its two faces, and that areas and volumes measured again are the part's own.
void expect_closed(Surface part) {
  for (const Border& border : part.borders)
    for (const std::uint32_t face : border.face) ASSERT_LT(face, part.faces.size());
  for (std::uint32_t f = 0; f < part.faces.size(); ++f)
    for (std::uint32_t l = part.faces[f].first_loop; l < part.faces[f].first_loop + part.faces[f].loop_count; ++l)
      for (std::uint32_t n = 0; n < part.loops[l].half_border_count; ++n) {
        const HalfBorder half = part.half_borders[part.loops[l].first_half_border + n];
        ASSERT_EQ(part.borders[half / 2].face[half & 1], f);
      }
  const Surface before = part;
  part.area = part.volume = 0;
  for (Component& component : part.components) component.area = component.volume = 0;
  measure_surface(part);
  EXPECT_NEAR(part.area, before.area, 1e-9 * (1 + before.area));
  EXPECT_NEAR(part.volume, before.volume, 1e-6 * (1 + std::abs(before.volume)));  // ties of gases on a grid
  double atoms = 0;
  for (const double area : atom_areas(before).surface) atoms += area;
  EXPECT_NEAR(atoms, before.area, 1e-9 * (1 + before.area));
}

// Checks that the planes of every patch leave the area of its faces: nothing of a removed face, all of one that stayed.
void expect_clipped(const Surface& part, int samples, std::mt19937& random) {
  for (const PatchKind kind : {PatchKind::convex, PatchKind::toroidal, PatchKind::concave})
    for (std::uint32_t patch = 0; patch < patch_count(part, kind); ++patch) {
      int inside = 0;
      for (int n = 0; n < samples; ++n) inside += sample_patch(part, kind, patch, random).inside;
      const double share = std::clamp(face_area(part, kind, patch) / whole_area(part, kind, patch), 0.0, 1.0);
      EXPECT_NEAR(inside, share * samples, 6 * std::sqrt(samples * share * (1 - share)) + 4)
          << "kind " << int(kind) << ", patch " << patch;
    }
}

std::vector<bool> only(const Surface& s, std::size_t component) {
  std::vector<bool> keep(s.components.size(), false);
  keep[component] = true;
  return keep;
}

TEST(Part, EachComponentOfManyMoleculesIsClosedAndClipped) {
  std::mt19937 random(17);
  std::size_t mixed = 0, parts = 0;
  const auto check = [&](const Balls& balls, double probe_radius) {
    const Surface s = compute_surface_cpu(balls, probe_radius);
    if (s.components.size() < 2) return;
    mixed += mixed_patches(s);
    double area = 0, volume = 0;
    for (std::size_t c = 0; c < s.components.size(); ++c) {
      const SurfacePart part = part_of(s, only(s, c));
      expect_closed(part.surface);
      if (probe_radius > 0) expect_clipped(part.surface, 400, random);
      area += part.surface.area;
      volume += part.surface.volume;
      for (std::size_t n = 0; n < part.atom.size(); ++n)
        ASSERT_EQ(part.surface.atoms[n].center, s.atoms[part.atom[n]].center);
      ++parts;
    }
    EXPECT_NEAR(area, s.area, 1e-9 * s.area);
    EXPECT_NEAR(volume, s.volume, 1e-9 * std::abs(s.volume));
  };
  check(ubiquitin(), 1.4);
  check(ubiquitin(), 0.0);
  for (const NamedBalls& molecule : degenerate_molecules()) {
    SCOPED_TRACE(molecule.name);
    check(molecule.balls, molecule.probe_radius);
  }
  for (std::uint32_t n = 0; n < 60; ++n) {
    SCOPED_TRACE("gas " + std::to_string(n));
    const GasCase gas = gas_case(n);
    check(gas.balls, gas.probe_radius);
  }
  EXPECT_GT(parts, 100u);
  EXPECT_GT(mixed, 100u);
}

TEST(Part, KeepingEverythingChangesNothing) {
  const Surface s = compute_surface_cpu(c60(), kWater);
  const SurfacePart part = part_of(s, std::vector<bool>(s.components.size(), true));
  EXPECT_EQ(part.surface.area, s.area);
  EXPECT_EQ(part.surface.counts().convex, s.counts().convex);
  EXPECT_EQ(part.surface.counts().arcs, s.counts().arcs);
  EXPECT_EQ(part.surface.planes.size(), s.planes.size());
}

TEST(Part, OnePieceOfASpindleIsADropAroundItsAtom) {
  const Surface s = compute_surface_cpu(two_atoms(5.8), kWater);
  ASSERT_EQ(s.counts().spindle, 1u);
  ASSERT_EQ(s.components.size(), 2u);
  for (std::size_t c = 0; c < 2; ++c) {
    const SurfacePart part = part_of(s, only(s, c));
    ASSERT_EQ(part.surface.toroidal.size(), 1u);
    const ToroidalPatch& torus = part.surface.toroidal.front();
    EXPECT_NE(torus.has_piece[0], torus.has_piece[1]);
    EXPECT_NEAR(part.surface.area, 0.5 * s.area, 1e-9);
    expect_closed(part.surface);
  }
}

// Returns a cage with a guest, by the lattice's own symmetry: a shell of carbon atoms with one in the middle.
Balls cage_with_guest(double radius_of_guest) {
  Balls balls = c60(3.0);  // a wide cage: edges of 3 Å, 7.4 Å from the middle
  balls.push_back({glm::dvec3(0.0), radius_of_guest});
  return balls;
}

TEST(Cavities, AnIslandInACavityIsNotReachedFromOutside) {
  const Surface s = compute_surface_cpu(cage_with_guest(1.2), 2.0);
  ASSERT_EQ(s.components.size(), 3u);
  std::size_t outer = 0;
  for (const Component& component : s.components) outer += component.kind == ComponentKind::outer;
  ASSERT_EQ(outer, 2u);
  const std::vector<bool> reached = reached_from_outside(s);
  EXPECT_EQ(std::count(reached.begin(), reached.end(), true), 1);
  EXPECT_TRUE(reached[0]);  // The largest outer component comes first.
  const SurfacePart outside = part_of(s, reached);
  EXPECT_EQ(outside.surface.components.size(), 1u);
  EXPECT_EQ(outside.surface.components[0].kind, ComponentKind::outer);
}

TEST(Cavities, FarApartMoleculesAreAllOutside) {
  Balls balls = c60();
  const Balls second = translated(c60(), {30, 0, 0});
  balls.insert(balls.end(), second.begin(), second.end());
  const Surface s = compute_surface_cpu(balls, kWater);
  const std::vector<bool> reached = reached_from_outside(s);
  EXPECT_EQ(std::count(reached.begin(), reached.end(), true), 2);
  EXPECT_EQ(reached.size(), 4u);
}

TEST(WindingNumber, TellsInsideFromOutsideInAnyDirection) {
  const Surface s = compute_surface_cpu(cage_with_guest(1.2), 2.0);
  for (std::uint32_t c = 0; c < s.components.size(); ++c) {
    const bool cavity = s.components[c].kind == ComponentKind::cavity;
    EXPECT_EQ(winding_number(s, c, glm::dvec3(0.0)), cavity ? -1 : 1) << c;
    EXPECT_EQ(winding_number(s, c, glm::dvec3(200.0, 3.0, -7.0)), 0);
  }
}

// Returns circles on the unit sphere around two axes, as faces of a made-up surface.
Surface two_caps(double angle_between, double radius_a, double radius_b) {
  Surface s;
  for (const auto& [turn, cap] : {std::pair{0.0, radius_a}, {angle_between, radius_b}}) {
    Border border;
    border.axis = {std::sin(turn), 0, std::cos(turn)};
    border.center = border.axis * std::cos(cap);
    border.start = {std::cos(turn), 0, -std::sin(turn)};
    border.radius = std::sin(cap);
    border.sweep = 2 * std::numbers::pi;
    const auto n = static_cast<std::uint32_t>(s.borders.size());
    s.borders.push_back(border);
    s.half_borders.push_back(2 * n);
    s.loops.push_back({n, 1});
    Face face;
    face.first_loop = n;
    face.loop_count = 1;
    s.faces.push_back(face);
  }
  return s;
}

TEST(Parting, ThePlaneBetweenTwoCapsHalvesTheirDistance) {
  const std::uint32_t first = 0, second = 1;
  for (const double angle : {0.7, 1.5, 3.0}) {
    const Surface s = two_caps(angle, 0.3, 0.2);
    const auto plane = plane_between(s, std::span(&first, 1), std::span(&second, 1));
    ASSERT_TRUE(plane.has_value()) << angle;
    // The nearest points of the two discs lie in the plane of their axes, on the rims that face each other, or inside.
    const auto on_sphere = [](double t) { return glm::dvec3(std::sin(t), 0, std::cos(t)); };
    const double below = plane->offset - glm::dot(plane->normal, on_sphere(0.3));
    const double above = glm::dot(plane->normal, on_sphere(angle - 0.2)) - plane->offset;
    EXPECT_GT(below, 0.0);
    EXPECT_GT(above, 0.0);
    if (angle < 1.0) {
      EXPECT_NEAR(below, above, 1e-3);
    }
  }
}

TEST(Parting, NoPlaneBetweenCapsThatOverlap) {
  const std::uint32_t first = 0, second = 1;
  const Surface s = two_caps(0.45, 0.3, 0.2);
  EXPECT_FALSE(plane_between(s, std::span(&first, 1), std::span(&second, 1)).has_value());
}

}  // namespace
}  // namespace meniscus::testing
