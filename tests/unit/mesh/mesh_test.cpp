// SPDX-License-Identifier: BSD-3-Clause
// Meshes of many surfaces: closed, outward, of the right topology, on the surface, within the tolerance both ways,
// crisply coloured.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/base/error.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/tessellate.h"
#include "core/surface/compute_surface.h"
#include "tests/support/distance_to_mesh.h"
#include "tests/support/molecules.h"
#include "tests/support/sphere_tracer.h"
#include "core/color/coloring.h"

namespace meniscus::testing {
namespace {

void expect_closed_with_topology(const Surface& surface, const TriangleMesh& mesh) {
  ASSERT_TRUE(measure(mesh).closed);
  for (std::uint32_t c = 0; c < surface.components.size(); ++c) {
    const MeshMeasure m = measure(mesh, c);
    EXPECT_TRUE(m.closed);
    EXPECT_EQ(m.euler(), surface.components[c].euler) << "component " << c;
    EXPECT_EQ(m.volume > 0.0, surface.components[c].volume > 0.0) << "component " << c;
  }
}

/// Checks vertices and random points of triangles with the oracle, which knows only the balls. Points lie a little next
/// to the vertices: exactly on the axis of a circle no point of the circle is nearest.
void expect_on_surface(const Balls& balls, double probe, const TriangleMesh& mesh) {
  const glm::dvec3 beside(2e-8, -1e-8, 3e-8);
  const SphereTracer oracle(balls, probe, mesh.tolerance + 0.05);
  std::mt19937 random(5);
  const std::size_t stride = 1 + mesh.positions.size() / 4000;
  for (std::size_t i = 0; i < mesh.positions.size(); i += stride) {
    ASSERT_NEAR(oracle.nearest(mesh.positions[i] + beside).distance, probe, 1e-7) << "vertex " << i;
  }
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 4000; ++i) {
    const auto& t = mesh.triangles[random() % mesh.triangles.size()];
    double a = share(random), b = share(random);
    if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
    const glm::dvec3 x = mesh.positions[t[0]] + a * (mesh.positions[t[1]] - mesh.positions[t[0]]) +
                         b * (mesh.positions[t[2]] - mesh.positions[t[0]]);
    ASSERT_NEAR(oracle.nearest(x).distance, probe, mesh.tolerance * 1.001 + 1e-9) << "triangle " << i;
  }
}

/// Checks that every corner's normal is its face's sphere's or torus's, and agrees with the triangle's orientation.
void expect_exact_normals(const Surface& surface, const TriangleMesh& mesh) {
  std::size_t sharp = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = static_cast<std::uint32_t>(3 * t + k);
      glm::dvec3 normal = mesh.normals[mesh.triangles[t][k]];
      if (sharp < mesh.sharp_corners.size() && mesh.sharp_corners[sharp] == corner) {
        normal = mesh.sharp_corner_normals[sharp++];
      }
      ASSERT_NEAR(glm::length(normal), 1.0, 1e-12);
      const glm::dvec3 x = mesh.positions[mesh.triangles[t][k]];
      const std::uint32_t patch = mesh.patch[t];
      if (mesh.kind[t] == PatchKind::convex) {
        const Ball& ball = surface.atoms[surface.convex[patch].atom];
        ASSERT_LT(glm::distance(normal, (x - ball.center) / ball.radius), 1e-4);
      } else if (mesh.kind[t] == PatchKind::concave) {
        ASSERT_LT(glm::distance(normal, (surface.concave[patch].center - x) / surface.probe_radius), 1e-4);
      } else {  // the probe that touches x is on the SAS circle
        const ToroidalPatch& torus = surface.toroidal[patch];
        const glm::dvec3 probe = x + surface.probe_radius * normal - torus.center;
        ASSERT_NEAR(glm::dot(probe, torus.axis), 0.0, 1e-4);
        ASSERT_NEAR(glm::length(probe), torus.radius, 1e-4);
      }
    }
  }
  EXPECT_EQ(sharp, mesh.sharp_corners.size());
}

/// Checks that no triangle reaches over a line where the nearest contact changes.
void expect_crisp_colors(const Surface& surface, const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.kind[t] != PatchKind::concave) continue;
    const ConcavePatch& patch = surface.concave[mesh.patch[t]];
    const auto contacts = contact_directions(surface, patch);
    for (const std::uint32_t v : mesh.triangles[t]) {
      const glm::dvec3 u = (mesh.positions[v] - patch.center) / surface.probe_radius;
      double best = -2.0, own = -2.0;
      for (const auto& contact : contacts) {
        best = std::max(best, glm::dot(contact.direction, u));
        if (contact.atom == mesh.atom[t]) own = glm::dot(contact.direction, u);
      }
      ASSERT_GT(own, best - 5e-3) << "triangle " << t;
    }
  }
}

struct MeshCase {
  std::string name;
  Balls balls;
  double probe = kWater;
  double tolerance = 0.02;
};

std::vector<MeshCase> mesh_cases() {
  std::vector<MeshCase> all{{"one", {{{1, 2, 3}, kCarbon}}},
                            {"two", two_atoms(4.0)},
                            {"free_spindle", two_atoms(5.8)},
                            {"uneven_spindle", two_atoms(5.3, 1.7, 1.2)},
                            {"nearly_tangent", two_atoms(6.2 - 1e-7)},
                            {"one_sided_small_circle", {{{0, 0, 0}, 3.0}, {{2.6, 0, 0}, 0.5}}},
                            {"apart", two_atoms(9.0)},
                            {"collinear", collinear(3, 3.0)},
                            {"square", ring(4, 3.0)},
                            {"hexagon", ring(6, 3.6)},
                            {"tetrahedron", tetrahedron(3.0)},
                            {"c60_with_cavity", c60()},
                            {"lattice", lattice(4, 4, 4, 2.0)},
                            {"wide_lattice", lattice(3, 3, 3, 3.4), 0.7},
                            {"small_probe", ring(5, 3.0), 0.3},
                            {"coarse", ring(5, 3.0), 1.4, 0.5},
                            {"fine", tetrahedron(3.0), 1.4, 0.001},
                            {"gas", gas(3, 25, 9.0, 1.0, 2.0), 1.1},
                            {"loose_gas", gas(4, 25, 14.0, 1.0, 2.0), 2.0}};
  for (const double step : {1e-3, 1e-9}) {  // the probe's circle hardly smaller or larger than the probe
    for (const double sign : {-1.0, 1.0}) {
      const double circle = kWater * (1.0 + sign * step);
      const double half = std::sqrt((kCarbon + kWater) * (kCarbon + kWater) - circle * circle);
      all.push_back({"throat_" + std::to_string(all.size()), two_atoms(2 * half)});
    }
  }
  return all;
}

class MeshOf : public ::testing::TestWithParam<MeshCase> {};

TEST_P(MeshOf, IsClosedOnTheSurfaceAndExactInItsNormals) {
  const MeshCase& c = GetParam();
  const Surface surface = compute_surface_cpu(c.balls, c.probe);
  const TriangleMesh mesh = tessellate(surface, {c.tolerance, true});
  expect_closed_with_topology(surface, mesh);
  expect_on_surface(c.balls, c.probe, mesh);
  expect_exact_normals(surface, mesh);
  expect_crisp_colors(surface, mesh);
  const MeshMeasure m = measure(mesh);
  EXPECT_NEAR(m.area, surface.area, 3.0 * c.tolerance * surface.area);
  EXPECT_NEAR(m.volume, surface.volume, c.tolerance * surface.area);
}

TEST_P(MeshOf, LeavesNoPointOfTheSurfaceOutOfTolerance) {
  const MeshCase& c = GetParam();
  const Surface surface = compute_surface_cpu(c.balls, c.probe);
  for (const double tolerance : {c.tolerance, 0.1, 0.3}) {
    const std::vector<glm::dvec3> points = tessellate(surface, {tolerance / 8.0, false}).positions;
    EXPECT_LE(farthest_from(tessellate(surface, {tolerance, true}), points), tolerance) << tolerance;
  }
}

INSTANTIATE_TEST_SUITE_P(Molecules, MeshOf, ::testing::ValuesIn(mesh_cases()),
                         [](const auto& test) { return test.param.name; });

TEST(Mesh, DegenerateMoleculesAreClosedAtAnyTolerance) {
  for (const NamedBalls& molecule : degenerate_molecules()) {
    const Surface surface = compute_surface_cpu(molecule.balls, molecule.probe_radius);
    for (const double tolerance : {0.3, 0.03}) {
      SCOPED_TRACE(molecule.name);
      expect_closed_with_topology(surface, tessellate(surface, {tolerance, true}));
    }
  }
}

TEST(Mesh, RandomMoleculesAreClosed) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const Balls balls = gas(seed, 2 + seed % 20, 8.0, 0.9, 2.0);
    const Surface surface = compute_surface_cpu(balls, 0.5 + 0.012 * seed);
    SCOPED_TRACE(seed);
    expect_closed_with_topology(surface, tessellate(surface, {seed % 2 ? 1.0 : 0.02, true}));
  }
}

TEST(Mesh, AreaAndVolumeConvergeInSecondOrderOfTheEdgeLength) {
  const Surface surface = compute_surface_cpu(c60(), kWater);
  double area_error = 0.0, volume_error = 0.0;
  for (const double tolerance : {0.064, 0.016, 0.004, 0.001}) {  // halves the edges each time
    const MeshMeasure m = measure(tessellate(surface, {tolerance, true}));
    const double area = std::abs(m.area - surface.area), volume = std::abs(m.volume - surface.volume);
    if (area_error > 0.0) {
      EXPECT_LT(area, area_error / 2.5);
      EXPECT_LT(volume, volume_error / 2.5);
    }
    area_error = area;
    volume_error = volume;
  }
  EXPECT_LT(area_error, 1e-3 * surface.area);
}

TEST(Mesh, UbiquitinLiesOnItsSurfaceAndHasItsCavities) {
  const Balls balls = ubiquitin();
  const Surface surface = compute_surface_cpu(balls, kWater);
  const TriangleMesh mesh = tessellate(surface, {0.02, true});
  expect_closed_with_topology(surface, mesh);
  expect_on_surface(balls, kWater, mesh);
  expect_exact_normals(surface, mesh);
  expect_crisp_colors(surface, mesh);
  EXPECT_FALSE(mesh.sharp_edges.empty());
  const std::vector<glm::dvec3> points = tessellate(surface, {0.01, false}).positions;
  for (const double tolerance : {0.05, 0.1, 0.2, 0.4})
    EXPECT_LE(farthest_from(tessellate(surface, {tolerance, true}), points), tolerance) << tolerance;
}

TEST(Mesh, EnterotoxinIsClosedWithTheRightTopology) {
  const Surface surface = compute_surface_cpu(enterotoxin(), kWater);
  expect_closed_with_topology(surface, tessellate(surface, {0.1, true}));
}

TEST(Mesh, WithoutAProbeItIsTheVanDerWaalsSurface) {
  for (const Balls& balls : {two_atoms(2.4, 1.7, 1.2), c60(), lattice(3, 3, 3, 2.5)}) {
    const Surface surface = compute_surface_cpu(balls, 0.0);
    for (const double tolerance : {0.02, 0.005}) {
      const TriangleMesh mesh = tessellate(surface, {tolerance, true});
      expect_closed_with_topology(surface, mesh);
      const MeshMeasure m = measure(mesh);
      EXPECT_NEAR(m.volume, surface.volume, tolerance * surface.area);
      EXPECT_NEAR(m.area, surface.area, tolerance * surface.area);
    }
  }
}

TEST(Mesh, IsTheSameForAnyNumberOfThreads) {
  const Surface surface = compute_surface_cpu(gas(9, 40, 11.0, 1.2, 2.0), kWater);
  const TriangleMesh many = tessellate(surface);
  tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const TriangleMesh one = tessellate(surface);
  EXPECT_EQ(one.positions, many.positions);
  EXPECT_EQ(one.triangles, many.triangles);
}

TEST(Mesh, MeasureSeesAMissingAndATurnedTriangle) {
  const Surface surface = compute_surface_cpu(two_atoms(4.0), kWater);
  TriangleMesh mesh = tessellate(surface, {0.1, true});
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  EXPECT_FALSE(measure(mesh).closed);
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  EXPECT_TRUE(measure(mesh).closed);
  mesh.triangles.pop_back();
  EXPECT_FALSE(measure(mesh).closed);
}

TEST(Mesh, ATorusIsColoredBySidesOfItsMiddle) {
  const Surface surface = compute_surface_cpu(two_atoms(4.0), kWater);
  const TriangleMesh mesh = tessellate(surface, {0.01, true});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      const double x = mesh.positions[v].x - 0.5 * (surface.atoms[0].center.x + surface.atoms[1].center.x);
      EXPECT_TRUE(mesh.atom[t] == 0 ? x < 1e-9 : x > -1e-9);
    }
  }
}

TEST(Mesh, HiddenAtomsLeaveAHoleThatTheirOwnPartFills) {
  // Two atoms 5.6 Å apart are two drops: without the second one nothing is open.
  const std::pair<Balls, bool> cases[] = {
      {gas(9, 40, 11.0, 1.2, 2.0), false}, {two_atoms(4.0), false}, {two_atoms(5.6), true}, {c60(1.45), false}};
  for (const auto& [balls, closed] : cases) {
    const Surface surface = compute_surface_cpu(balls, kWater);
    const TriangleMesh whole = tessellate(surface, {0.05, true});
    Coloring shown, others;
    for (std::size_t a = 0; a < balls.size(); ++a) {
      shown.hidden.push_back(a % 3 == 1);
      others.hidden.push_back(a % 3 != 1);
    }
    const TriangleMesh part = shown_part(whole, shown), rest = shown_part(whole, others);
    EXPECT_TRUE(part.partly_hidden);
    EXPECT_EQ(measure(part).closed, closed);
    EXPECT_EQ(part.triangles.size() + rest.triangles.size(), whole.triangles.size());
    EXPECT_NEAR(measure(part).area + measure(rest).area, measure(whole).area, 1e-6);
    for (const std::uint32_t a : part.atom) EXPECT_TRUE(shown.shows(a));
    EXPECT_EQ(part.sharp_corners.size() + rest.sharp_corners.size(), whole.sharp_corners.size());
    // Each row still belongs to its triangle: the first corner's place, its normal, and the sharp ones.
    std::size_t t = 0, sharp = 0, whole_sharp = 0;
    for (std::size_t w = 0; w < whole.triangles.size(); ++w) {
      const bool kept = shown.shows(whole.atom[w]);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const bool is_sharp = whole_sharp < whole.sharp_corners.size() && whole.sharp_corners[whole_sharp] == 3 * w + k;
        if (kept && is_sharp) {
          ASSERT_EQ(part.sharp_corners[sharp], 3 * t + k);
          ASSERT_EQ(part.sharp_corner_normals[sharp++], whole.sharp_corner_normals[whole_sharp]);
        }
        whole_sharp += is_sharp;
        if (!kept) continue;
        ASSERT_EQ(part.positions[part.triangles[t][k]], whole.positions[whole.triangles[w][k]]);
        ASSERT_EQ(part.normals[part.triangles[t][k]], whole.normals[whole.triangles[w][k]]);
      }
      if (!kept) continue;
      ASSERT_EQ(part.patch[t], whole.patch[w]);
      ASSERT_EQ(part.kind[t], whole.kind[w]);
      ASSERT_EQ(part.component[t++], whole.component[w]);
    }
    std::vector<bool> used(part.positions.size(), false);
    for (const auto& triangle : part.triangles)
      for (const std::uint32_t v : triangle) used[v] = true;
    EXPECT_TRUE(std::ranges::all_of(used, [](bool u) { return u; }));
    for (const auto& e : part.sharp_edges) EXPECT_LT(std::max(e[0], e[1]), part.positions.size());
    EXPECT_EQ(shown_part(whole, {}).triangles, whole.triangles);
    EXPECT_FALSE(shown_part(whole, {}).partly_hidden);
  }
}

// Nobody is given a mesh of another surface: one face more by a sphere of the probe, one component the other way round.
TEST(Mesh, OfASurfaceWithOtherAreasOrVolumesIsRefused) {
  const Surface surface = compute_surface_cpu(ring(3, 3.0), kWater);
  EXPECT_NO_THROW(tessellate(surface, {0.1, false}));
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    Surface wrong = surface;
    wrong.faces[f].area += 4 * M_PI * kWater * kWater;
    EXPECT_THROW(tessellate(wrong, {0.1, false}), OpenSurfaceError) << f;
  }
  Surface wrong = surface;
  wrong.components[0].volume *= -1;
  EXPECT_THROW(tessellate(wrong, {0.1, false}), OpenSurfaceError);
}

TEST(Mesh, AToleranceThatIsNoLengthIsRefused) {
  const Surface surface = compute_surface_cpu(two_atoms(4.0), kWater);
  for (const double tolerance : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(tessellate(surface, {tolerance, true}), Error);
  }
}

}  // namespace
}  // namespace meniscus::testing
