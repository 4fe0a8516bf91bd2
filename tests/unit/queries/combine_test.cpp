// SPDX-License-Identifier: BSD-3-Clause
// Surfaces put together equal one computation of all their atoms, and copies are in their places.
#include "core/queries/copies.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "tests/support/patch_samples.h"
#include "tests/support/topology.h"
#include "core/queries/surface_object.h"

namespace meniscus::testing {
namespace {

SurfaceObject object_of(const Balls& balls, double probe_radius, std::uint32_t first_atom, glm::vec3 color) {
  SurfaceObject object;
  object.name = "object";
  object.surface = compute_surface_cpu(balls, probe_radius);
  object.coloring.atom.assign(balls.size(), color);
  object.atom.resize(balls.size());
  std::iota(object.atom.begin(), object.atom.end(), first_atom);
  return object;
}

RigidMotion some_motion() {
  std::mt19937 random(5);
  return {random_rotation(random), {60.0, -35.0, 20.0}};
}

Balls moved(const Balls& balls, const RigidMotion& motion) {
  Balls result = balls;
  for (Ball& ball : result) ball.center = motion(ball.center);
  return result;
}

// Checks that every index of the boundary representation leads to a row, and that rows belong together in space.
void expect_consistent(const Surface& s) {
  constexpr double kSmall = 1e-9;
  for (std::uint32_t f = 0; f < s.faces.size(); ++f) {
    const Face& face = s.faces[f];
    ASSERT_LT(face.component, s.components.size());
    for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l)
      for (std::uint32_t n = 0; n < s.loops[l].half_border_count; ++n) {
        const HalfBorder half = s.half_borders[s.loops[l].first_half_border + n];
        const Border& border = s.borders[half / 2];
        ASSERT_EQ(border.face[half & 1], f);
        const glm::dvec3 point = border.center + border.radius * border.start;
        if (border.vertex[0] != kNone) {
          ASSERT_NEAR(glm::distance(point, s.vertices[border.vertex[0]]), 0, kSmall);
        }
        if (face.kind == PatchKind::convex) {
          const Ball& atom = s.atoms[s.convex[face.patch].atom];
          ASSERT_NEAR(glm::distance(point, atom.center), atom.radius, kSmall);
        } else if (face.kind == PatchKind::concave) {
          ASSERT_NEAR(glm::distance(point, s.concave[face.patch].center), s.probe_radius, kSmall);
        }
      }
  }
  for (const ToroidalPatch& t : s.toroidal)
    for (int end = 0; end < 2 && !t.free(); ++end) {
      const double angle = end * t.sweep;
      const glm::dvec3 at =
          t.center + t.radius * (std::cos(angle) * t.start + std::sin(angle) * glm::cross(t.axis, t.start));
      ASSERT_NEAR(glm::distance(at, s.concave[t.probe[end]].center), 0, 1e-6);
    }
  for (const ConcavePatch& patch : s.concave)
    for (std::uint32_t c = 0; c < patch.cut_count; ++c) {
      const Plane& plane = s.planes[patch.first_plane + patch.side_count + c];
      const glm::dvec3 middle = 0.5 * (patch.center + s.concave[s.cuts[patch.first_cut + c]].center);
      ASSERT_NEAR(glm::dot(plane.normal, middle), plane.offset, kSmall);
    }
}

TEST(Combine, CopiesFarApartAreOneComputationOfAllTheirAtoms) {
  for (const Balls& balls : {ubiquitin(), c60(), two_atoms(5.5)}) {
    const RigidMotion motion = some_motion();
    Balls all = balls;
    const Balls second = moved(balls, motion);
    all.insert(all.end(), second.begin(), second.end());
    const Surface expected = compute_surface_cpu(all, kWater);

    Surface whole;
    const Surface part = compute_surface_cpu(balls, kWater);
    append(whole, part);
    append(whole, part, motion);
    EXPECT_TRUE(whole.certificate.closed);
    EXPECT_EQ(topology_of(whole), topology_of(expected));
    EXPECT_NEAR(whole.area, expected.area, 1e-9 * expected.area);
    EXPECT_NEAR(whole.volume, expected.volume, 1e-9 * expected.volume);
    expect_consistent(whole);
    for (std::size_t n = 0; n < all.size(); ++n) EXPECT_EQ(glm::distance(whole.atoms[n].center, all[n].center), 0.0);
  }
}

TEST(Combine, PlanesOfACopyClipWhatTheyClippedBefore) {
  Surface whole = compute_surface_cpu(two_atoms(4.0), kWater);
  append(whole, compute_surface_cpu(ubiquitin(), kWater), some_motion());
  expect_consistent(whole);
  std::mt19937 random(9);
  for (const PatchKind kind : {PatchKind::convex, PatchKind::concave})
    for (std::uint32_t patch = 0; patch < patch_count(whole, kind); patch += 7) {
      int inside = 0;
      constexpr int kSamples = 500;
      for (int n = 0; n < kSamples; ++n) inside += sample_patch(whole, kind, patch, random).inside;
      const double share = std::clamp(face_area(whole, kind, patch) / whole_area(whole, kind, patch), 0.0, 1.0);
      EXPECT_NEAR(inside, share * kSamples, 6 * std::sqrt(kSamples * share * (1 - share)) + 4);
    }
}

TEST(Combine, MergedObjectsKeepColorsAtomsAndWhatIsHidden) {
  std::vector<SurfaceObject> objects{object_of(two_atoms(4.0), kWater, 0, {1, 0, 0}),
                                     object_of(collinear(3, 3.0), kWater, 2, {0, 1, 0})};
  objects[0].copies.push_back(some_motion());
  objects[1].copies = {{glm::dmat3(1.0), {0.0, 50.0, 0.0}}};
  objects[1].coloring.hidden = {false, true, false};
  objects[0].coloring.opacity = {0.5f, 1.0f};
  const std::vector<Ball> balls = placed_balls(objects);
  const SurfaceObject whole = merged(objects);
  EXPECT_EQ(whole.coloring.opacity, (std::vector<float>{0.5f, 1.0f, 0.5f, 1.0f, 1.0f, 1.0f, 1.0f}));
  EXPECT_EQ(whole.atom, (std::vector<std::uint32_t>{0, 1, 0, 1, 2, 3, 4}));
  EXPECT_EQ(whole.coloring.hidden, (std::vector<bool>{false, false, false, false, false, true, false}));
  EXPECT_EQ(whole.coloring.atom[3], glm::vec3(1, 0, 0));
  EXPECT_EQ(whole.coloring.atom[4], glm::vec3(0, 1, 0));
  EXPECT_EQ(whole.copies.size(), 1u);
  ASSERT_EQ(balls.size(), whole.surface.atoms.size());
  for (std::size_t n = 0; n < balls.size(); ++n) EXPECT_EQ(balls[n].center, whole.surface.atoms[n].center);
  EXPECT_EQ(balls[4].center.y, 50.0);
  EXPECT_NEAR(whole.surface.area, 2 * objects[0].surface.area + objects[1].surface.area, 1e-9);
}

TEST(Combine, OnePlainObjectIsNotCopied) {
  std::vector<SurfaceObject> objects{object_of(ubiquitin(), kWater, 0, {1, 1, 1})};
  const void* const borders = objects[0].surface.borders.data();
  const SurfaceObject whole = merged(std::move(objects));
  EXPECT_EQ(whole.surface.borders.data(), borders);
}

TEST(Combine, AnEmptySurfaceAddsNothing) {
  Surface whole = compute_surface_cpu(c60(), kWater);
  const double area = whole.area;
  append(whole, compute_surface_cpu({}, kWater), some_motion());
  EXPECT_EQ(whole.area, area);
  EXPECT_TRUE(merged({}).surface.atoms.empty());
}

}  // namespace
}  // namespace meniscus::testing
