// SPDX-License-Identifier: BSD-3-Clause
// Sections of solids: areas by closed forms and by volumes, points by the oracle, closed solids, borders of parts.
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/mesh/section_mesh.h"
#include "core/mesh/tessellate.h"
#include "core/queries/copies.h"
#include "core/queries/surface_object.h"
#include "core/queries/surface_parts.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

/// Makes each atom a part of its own.
CapAtoms every_atom(const Surface& surface) {
  std::vector<std::uint32_t> part(surface.atoms.size());
  for (std::uint32_t a = 0; a < part.size(); ++a) part[a] = a;
  return {surface.atoms, surface.probe_radius, part};
}

CapAtoms one_part(const Surface& surface) {
  return {surface.atoms, surface.probe_radius, std::vector<std::uint32_t>(surface.atoms.size(), 0)};
}

double area(const CapMesh& caps, std::uint32_t plane = kNone) {
  double sum = 0.0;
  for (std::size_t n = 0; n < caps.triangles.size(); ++n) {
    const auto& [a, b, c] = caps.triangles[n];
    const std::vector<glm::dvec3>& x = caps.positions;
    if (plane == kNone || caps.plane[n] == plane) sum += 0.5 * glm::length(glm::cross(x[b] - x[a], x[c] - x[a]));
  }
  return sum;
}

/// Returns the share of the caps' area whose triangles have their middles in the solvent: only chords along rims cause
/// any.
double share_in_solvent(const CapMesh& caps, const Surface& surface) {
  double wrong = 0.0;
  for (std::size_t n = 0; n < caps.triangles.size(); ++n) {
    const auto& [a, b, c] = caps.triangles[n];
    const std::vector<glm::dvec3>& x = caps.positions;
    if (in_solvent(surface.atoms, surface.probe_radius, (x[a] + x[b] + x[c]) / 3.0))
      wrong += 0.5 * glm::length(glm::cross(x[b] - x[a], x[c] - x[a]));
  }
  return wrong / area(caps);
}

/// Returns surface and caps as one mesh.
TriangleMesh joined(const CutMesh& cut) {
  TriangleMesh mesh = cut.surface;
  std::vector<std::uint32_t> place;
  for (std::size_t v = 0; v < cut.caps.positions.size(); ++v) {
    if (cut.caps.rim[v] != kNone) {
      EXPECT_EQ(cut.surface.positions[cut.caps.rim[v]], cut.caps.positions[v]);
    }
    place.push_back(cut.caps.rim[v] != kNone ? cut.caps.rim[v] : static_cast<std::uint32_t>(mesh.positions.size()));
    if (cut.caps.rim[v] == kNone) mesh.positions.push_back(cut.caps.positions[v]);
  }
  for (const auto& t : cut.caps.triangles) mesh.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  return mesh;
}

TEST(SectionMesh, OfABallIsADisk) {
  const Surface surface = compute_surface_cpu(Balls{{{1.0, 2.0, 3.0}, 2.0}}, 1.4);
  const ClipPlane plane{{0.0, 0.0, 1.0}, 4.2};
  const double exact = kPi * (4.0 - 1.2 * 1.2);
  double before = 1.0;
  for (const double tolerance : {0.02, 0.002}) {
    const CutMesh cut = cut_mesh(tessellate(surface, {tolerance, true}), {&plane, 1}, one_part(surface));
    const double error = exact - area(cut.caps);
    EXPECT_GT(error, 0.0);  // Chords of a circle lose area.
    EXPECT_LT(error, 2.0 * kPi * 2.0 * tolerance / 0.8);
    EXPECT_LT(error, before);
    before = error;
    for (std::size_t n = 0; n < cut.caps.triangles.size(); ++n) {
      const auto& [a, b, c] = cut.caps.triangles[n];
      const std::vector<glm::dvec3>& x = cut.caps.positions;
      EXPECT_GT(glm::cross(x[b] - x[a], x[c] - x[a]).z, 0.0);
      EXPECT_NEAR(x[a].z, 4.2, 1e-5);
    }
  }
}

// Across the axis between two atoms the saddle is a circle: the probe's height off its own circle tells how large.
TEST(SectionMesh, OfATorusIsItsCircle) {
  const Surface surface = compute_surface_cpu(two_atoms(4.0), 1.4);
  ASSERT_EQ(surface.toroidal.size(), 1u);
  const ToroidalPatch& saddle = surface.toroidal[0];
  for (const double off : {0.0, 0.3, -0.45}) {
    const ClipPlane plane{saddle.axis, glm::dot(saddle.axis, saddle.center) + off};
    const CutMesh cut = cut_mesh(tessellate(surface, {0.001, true}), {&plane, 1}, one_part(surface));
    const double radius = saddle.radius - std::sqrt(1.4 * 1.4 - off * off);
    EXPECT_NEAR(area(cut.caps), kPi * radius * radius, 2.0 * kPi * radius * 0.002) << off;
  }
}

TEST(SectionMesh, IsAnnularWhereACavityIsOpen) {
  const Surface surface = compute_surface_cpu(c60(), 0.5);
  ASSERT_EQ(surface.components.size(), 2u);
  const ClipPlane plane{glm::normalize(glm::dvec3(0.2, -0.4, 0.9)), 0.3};
  const CutMesh cut = cut_mesh(tessellate(surface, {0.005, true}), {&plane, 1}, every_atom(surface));
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto& t : cut.caps.triangles)
    for (int k = 0; k < 3; ++k) edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  EXPECT_EQ(int(cut.caps.positions.size()) - int(edges.size()) + int(cut.caps.triangles.size()), 0);
  EXPECT_TRUE(measure(joined(cut)).closed);
  EXPECT_LT(share_in_solvent(cut.caps, surface), 1e-4);
}

TEST(SectionMesh, HalvesAddUpToTheWhole) {
  for (const NamedBalls& molecule : {NamedBalls{"1UBQ", ubiquitin()}, NamedBalls{"no probe", ubiquitin(), 0.0},
                                     NamedBalls{"C60", c60(), 0.5}, NamedBalls{"lattice", lattice(3, 3, 3, 3.0)}}) {
    const Surface surface = compute_surface_cpu(molecule.balls, molecule.probe_radius);
    const TriangleMesh mesh = tessellate(surface, {0.03, true});
    glm::dvec3 center(0.0);
    for (const Ball& ball : molecule.balls) center += ball.center / double(molecule.balls.size());
    // The axes of lattices meet whole rows of vertices.
    for (const glm::dvec3& normal : {glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(0.3, 1, -0.2))}) {
      const ClipPlane front{normal, glm::dot(normal, center)}, back{-normal, -glm::dot(normal, center)};
      const CutMesh a = cut_mesh(mesh, {&front, 1}, every_atom(surface)),
                    b = cut_mesh(mesh, {&back, 1}, every_atom(surface));
      EXPECT_TRUE(measure(joined(a)).closed && measure(joined(b)).closed) << molecule.name;
      EXPECT_NEAR(area(a.caps), area(b.caps), 1e-4 * area(a.caps)) << molecule.name;
      EXPECT_NEAR(sums_of(joined(a)).volume + sums_of(joined(b)).volume, sums_of(mesh).volume,
                  1e-5 * sums_of(mesh).volume)
          << molecule.name;
    }
  }
}

TEST(SectionMesh, AreasOverSlabsAreTheVolume) {
  const Surface surface = compute_surface_cpu(ubiquitin(), 1.4);
  const TriangleMesh mesh = tessellate(surface, {0.05, false});
  double low = 1e9, high = -1e9;
  for (const glm::dvec3& x : mesh.positions) low = std::min(low, x.x), high = std::max(high, x.x);
  const int count = 60;
  const double step = (high - low) / count;
  double volume = 0.0;
  for (int n = 0; n < count; ++n) {
    const ClipPlane plane{{1.0, 0.0, 0.0}, low + (n + 0.5) * step};
    volume += step * area(cut_mesh(mesh, {&plane, 1}, one_part(surface)).caps);
  }
  EXPECT_NEAR(volume, sums_of(mesh).volume, 1e-3 * volume);
}

TEST(SectionMesh, PlanesCutEachOthersCaps) {
  const Surface surface = compute_surface_cpu(enterotoxin(), 1.4);
  const TriangleMesh mesh = tessellate(surface, {0.1, true});
  glm::dvec3 center(0.0);
  for (const Ball& ball : surface.atoms) center += ball.center / double(surface.atoms.size());
  std::vector<ClipPlane> planes;
  for (const glm::dvec3& direction : {glm::dvec3(1, 0.2, 0), glm::dvec3(-1, 0.1, 0.1), glm::dvec3(0.1, 1, 0.4)})
    planes.push_back({glm::normalize(direction), glm::dot(glm::normalize(direction), center) + 4.0});
  const CutMesh cut = cut_mesh(mesh, planes, every_atom(surface));
  EXPECT_TRUE(measure(joined(cut)).closed);
  for (std::uint32_t n = 0; n < planes.size(); ++n) EXPECT_GT(area(cut.caps, n), 100.0);
  for (const std::vector<glm::dvec3>* positions : {&cut.caps.positions, &cut.surface.positions})
    for (const glm::dvec3& x : *positions)
      for (const ClipPlane& plane : planes) EXPECT_LT(glm::dot(plane.normal, x), plane.offset + 1e-5);
  EXPECT_LT(share_in_solvent(cut.caps, surface), 2e-3);
  std::vector<ClipPlane> other = planes;
  std::swap(other[0], other[2]);
  const CutMesh same = cut_mesh(mesh, other, every_atom(surface));
  EXPECT_NEAR(area(same.caps, 2), area(cut.caps, 0), 1e-3);
}

TEST(SectionMesh, TrianglesHaveTheNearestAtom) {
  const Surface surface = compute_surface_cpu(ubiquitin(), 1.4);
  const CapAtoms atoms = every_atom(surface);
  const ClipPlane plane{{0.0, 1.0, 0.0}, 30.0};
  const CapMesh caps = cut_mesh(tessellate(surface, {0.01, true}), {&plane, 1}, atoms).caps;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  double wrong = 0.0, all = 0.0, farthest = 0.0;
  for (std::size_t n = 0; n < caps.triangles.size(); ++n) {
    const auto& [a, b, c] = caps.triangles[n];
    const std::vector<glm::dvec3>& x = caps.positions;
    const double size = glm::length(glm::cross(x[b] - x[a], x[c] - x[a]));
    double u = share(random), v = share(random);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const glm::dvec3 point = x[a] + u * (x[b] - x[a]) + v * (x[c] - x[a]);
    const CapAtoms::Nearest nearest = atoms.nearest(point);
    all += size;
    if (nearest.atom == caps.atom[n]) continue;
    wrong += size;
    farthest = std::max(farthest, atoms.distance(caps.atom[n], point) - nearest.distance);
  }
  EXPECT_LT(wrong, 0.006 * all);
  EXPECT_LT(farthest, 0.15);
}

// The border of two equal balls is the plane between them: the disk's halves have a closed form.
TEST(SectionMesh, PartsMeetWhereTheyAreEquallyNear) {
  const Surface surface = compute_surface_cpu(two_atoms(1.5), 1.4);
  const ClipPlane plane{{0.0, 0.0, 1.0}, 0.2};
  const CapMesh caps = cut_mesh(tessellate(surface, {0.002, true}), {&plane, 1}, every_atom(surface)).caps;
  const double border = 0.5 * (surface.atoms[0].center.x + surface.atoms[1].center.x);
  for (std::size_t n = 0; n < caps.triangles.size(); ++n)
    for (const std::uint32_t v : caps.triangles[n]) {
      const double beyond =
          (caps.positions[v].x - border) * (surface.atoms[caps.atom[n]].center.x > border ? 1.0 : -1.0);
      EXPECT_GT(beyond, -1e-9);
    }
}

TEST(SectionMesh, OfCopiesHasTheColorsOfAllAndLeavesOutTheHidden) {
  std::vector<SurfaceObject> objects(1);
  objects[0].surface = compute_surface_cpu(two_atoms(3.0), 1.4);
  objects[0].coloring.atom = {glm::vec3(1, 0, 0), glm::vec3(0, 0, 1)};
  objects[0].copies.push_back({glm::dmat3(1.0), {0.0, 10.0, 0.0}});
  const ClipPlane plane{{0.0, 0.0, 1.0}, 0.0};
  const CapMesh all = section_caps(objects, {&plane, 1}, false, 0.01);
  const CutMesh one =
      cut_mesh(tessellate(objects[0].surface, {0.01, false}), {&plane, 1}, every_atom(objects[0].surface));
  EXPECT_NEAR(area(all), 2.0 * area(one.caps), 1e-6);
  std::array<double, 4> share{};
  for (std::size_t n = 0; n < all.triangles.size(); ++n) share.at(all.atom[n]) += 1.0;
  for (const double count : share) EXPECT_GT(count, 0.0);
  objects[0].coloring.hidden = {false, true};
  EXPECT_NEAR(area(section_caps(objects, {&plane, 1}, true, 0.01)), area(one.caps), 0.02);
}

TEST(SectionMesh, PlanesThatMissCutNothing) {
  const Surface surface = compute_surface_cpu(two_atoms(3.0), 1.4);
  const TriangleMesh mesh = tessellate(surface, {0.05, true});
  const ClipPlane beyond{{1.0, 0.0, 0.0}, 100.0}, before{{1.0, 0.0, 0.0}, -100.0};
  EXPECT_EQ(cut_mesh(mesh, {&beyond, 1}, one_part(surface)).surface.triangles.size(), mesh.triangles.size());
  EXPECT_TRUE(cut_mesh(mesh, {&before, 1}, one_part(surface)).surface.triangles.empty());
  EXPECT_TRUE(cut_mesh(mesh, {&before, 1}, one_part(surface)).caps.triangles.empty());
}

}  // namespace
}  // namespace meniscus::testing
