// SPDX-License-Identifier: BSD-3-Clause
// Welding: short edges and flat triangles go where the mesh stays a closed surface of the same genus, and nowhere else.
#include "core/mesh/weld.h"
#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace meniscus {
namespace {

TriangleMesh mesh_of(std::vector<glm::dvec3> points, std::vector<std::array<std::uint32_t, 3>> triangles) {
  TriangleMesh mesh;
  mesh.normals.assign(points.size(), glm::dvec3(0, 0, 1));
  mesh.positions = std::move(points);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::vector<std::uint32_t>* table : {&mesh.face, &mesh.patch, &mesh.atom}) table->push_back(t);
    mesh.component.push_back(0);
    mesh.kind.push_back(PatchKind::convex);
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

int euler_if_closed(const TriangleMesh& mesh) {
  const MeshMeasure measured = measure(mesh);
  EXPECT_TRUE(measured.closed);
  EXPECT_EQ(measured.vertex_count, mesh.positions.size());
  return measured.euler();
}

Welding weld(TriangleMesh& mesh) { return meniscus::weld(mesh, 0.001, 1.0); }

// An octahedron whose upper corner is two, 0 and 6. Beside the edge from 0 to 2 a fin is between them: pairs of
// triangles back to back, one for each tip, the tip of one the foot of the next. Without tips 0 and 6 share that edge.
TriangleMesh octahedron_with_a_double_corner(double apart, const std::vector<glm::dvec3>& tips = {}) {
  std::vector<glm::dvec3> points{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {apart, 0, 1}};
  std::vector<std::array<std::uint32_t, 3>> triangles{{6, 1, 2}};
  std::uint32_t foot = 2;
  for (const glm::dvec3& point : tips) {
    const auto tip = static_cast<std::uint32_t>(points.size());
    points.push_back(point);
    triangles.insert(triangles.end(), {{6, foot, tip}, {foot, 0, tip}});
    foot = tip;
  }
  triangles.insert(
      triangles.end(),
      {{6, foot, 0}, {0, 2, 3}, {0, 3, 4}, {0, 4, 6}, {6, 4, 1}, {2, 1, 5}, {3, 2, 5}, {4, 3, 5}, {1, 4, 5}});
  return mesh_of(std::move(points), std::move(triangles));
}

TEST(Weld, TwoVerticesOnePointBecomeOneAndTheLowerStays) {
  TriangleMesh mesh = octahedron_with_a_double_corner(0.0004);
  ASSERT_EQ(euler_if_closed(mesh), 2);
  const Welding made = weld(mesh);
  EXPECT_EQ(made.joined, 1u);
  EXPECT_EQ(made.into, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 0}));
  EXPECT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.triangles.size(), 8u);
  EXPECT_EQ(mesh.atom.size(), 8u);
  EXPECT_EQ(euler_if_closed(mesh), 2);
  EXPECT_EQ(mesh.positions[0].x, 0.0);
}

TEST(Weld, LongerEdgesStay) {
  TriangleMesh mesh = octahedron_with_a_double_corner(0.01);
  EXPECT_EQ(weld(mesh).joined, 0u);
  EXPECT_EQ(mesh.positions.size(), 7u);
}

// A tetrahedron has no edge that could go: two triangles back to back would remain.
TEST(Weld, ATetrahedronStays) {
  TriangleMesh mesh =
      mesh_of({{0, 0, 0}, {0.0001, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  EXPECT_EQ(weld(mesh).flat, 2u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(euler_if_closed(mesh), 2);
}

// The neck of a double pyramid with three sides would be pinched without one of its edges.
TEST(Weld, ANeckStays) {
  TriangleMesh mesh = mesh_of({{0, 0, 1}, {0.0002, 0, 0}, {0, 0.0002, 0}, {-1, -1, 0}, {0, 0, -1}},
                              {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {2, 1, 4}, {3, 2, 4}, {1, 3, 4}});
  weld(mesh);
  EXPECT_EQ(mesh.positions.size(), 5u);  // 1 and 2 have three common neighbours
  EXPECT_EQ(euler_if_closed(mesh), 2);
}

// The fin has one tip, vertex 7, so far from the edge.
TriangleMesh octahedron_with_a_fin(double length) {
  const double out = 0.5 + length / std::sqrt(2.0);
  TriangleMesh mesh = octahedron_with_a_double_corner(0.0004, {{0, out, out}});
  mesh.sharp_edges = {{0, 7}, {2, 7}, {3, 4}};
  mesh.sharp_corners = {5, 13};  // The corners belong to triangle 1, at the tip, and to triangle 4.
  mesh.sharp_corner_normals = {{1, 0, 0}, {0, 1, 0}};
  mesh.tolerance = 0.05;
  return mesh;
}

TEST(Weld, AFinGoesThatKeepsVerticesApart) {
  TriangleMesh mesh = octahedron_with_a_fin(0.04);
  ASSERT_EQ(euler_if_closed(mesh), 2);
  const Welding made = weld(mesh);
  EXPECT_EQ(made.fins, 1u);
  EXPECT_EQ(made.joined, 1u);
  EXPECT_EQ(made.flat, 0u);
  EXPECT_EQ(made.into, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 0, kNone}));
  EXPECT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.triangles.size(), 8u);
  EXPECT_EQ(mesh.face, (std::vector<std::uint32_t>{0, 4, 5, 7, 8, 9, 10, 11}));
  EXPECT_EQ(mesh.sharp_edges, (std::vector<std::array<std::uint32_t, 2>>{{3, 4}}));
  EXPECT_EQ(mesh.sharp_corners, (std::vector<std::uint32_t>{4}));
  EXPECT_EQ(euler_if_closed(mesh), 2);
  EXPECT_NEAR(measure(mesh).volume, 4.0 / 3.0, 1e-12);
}

TEST(Weld, AFinOfSeveralTipsGoes) {
  for (const double apart : {0.02, 0.5}) {
    TriangleMesh mesh = octahedron_with_a_double_corner(0.0004, {{0, 0.6, 0.4 + apart}, {0, 0.3, 0.7 + apart}});
    mesh.tolerance = 0.05;
    ASSERT_EQ(euler_if_closed(mesh), 2);
    const Welding made = weld(mesh);
    EXPECT_EQ(euler_if_closed(mesh), 2);
    EXPECT_EQ(made.fins, apart < mesh.tolerance ? 2u : 0u);
    EXPECT_EQ(made.flat, apart < mesh.tolerance ? 0u : 2u);
    EXPECT_EQ(mesh.positions.size(), apart < mesh.tolerance ? 6u : 9u);
  }
}

// Without the fin the surface there would be farther from the mesh than the tolerance.
TEST(Weld, AFinLongerThanTheToleranceStays) {
  TriangleMesh mesh = octahedron_with_a_fin(0.06);
  const Welding made = weld(mesh);
  EXPECT_EQ(made.fins, 0u);
  EXPECT_EQ(made.joined, 0u);
  EXPECT_EQ(made.flat, 2u);
  EXPECT_EQ(mesh.positions.size(), 8u);
  EXPECT_EQ(euler_if_closed(mesh), 2);
}

// Files hold floats: where rounding to these brings two points to the same thousandth, they are one.
TEST(Weld, PointsThatAreOneInTheNumbersOfAFileAreJoined) {
  double edge = 100.0005;  // between thousandths
  while (!(double(float(edge - 1e-7)) > edge)) edge += 0.001;
  TriangleMesh mesh = octahedron_with_a_double_corner(0.0);
  for (glm::dvec3& x : mesh.positions) x.x += edge - 1e-7;
  mesh.positions[6] += glm::dvec3(0.00095, 0.00045, 0.0);
  ASSERT_GT(glm::distance(mesh.positions[0], mesh.positions[6]), 0.001);
  std::vector<std::array<std::uint32_t, 3>> triangles = mesh.triangles;
  EXPECT_EQ(weld_short_edges(mesh.positions, triangles, 0.001).joined, 0u);  // Numbers are not rounded.
  EXPECT_EQ(weld(mesh).joined, 1u);
}

// A tetrahedron with a vertex 6 on its edge from 0 to 1: both triangles there could be drawn without it; the one that
// has it as a corner beside the whole edge has no area.
TriangleMesh tetrahedron_with_a_flat_triangle(double off) {
  return mesh_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {2, off, 0}},
                 {{0, 2, 1}, {0, 1, 4}, {0, 4, 3}, {4, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

TEST(Weld, AFlatTriangleLosesItsLongestEdge) {
  for (const double off : {0.0, 0.0003}) {
    TriangleMesh mesh = tetrahedron_with_a_flat_triangle(off);
    ASSERT_EQ(euler_if_closed(mesh), 2);
    const double volume = measure(mesh).volume;
    const Welding made = weld(mesh);
    EXPECT_EQ(made.flipped, 1u);
    EXPECT_EQ(made.flat, 0u);
    EXPECT_EQ(mesh.positions.size(), 5u);
    EXPECT_EQ(mesh.triangles.size(), 6u);
    EXPECT_EQ(euler_if_closed(mesh), 2);
    EXPECT_NEAR(measure(mesh).volume, volume, 0.01);
    EXPECT_EQ(mesh.face, (std::vector<std::uint32_t>{0, 0, 2, 3, 4, 5}));  // both of the one that had an area
  }
}

TEST(Weld, WhereFlippedTrianglesBeginDoesNotDependOnWhereTheyBegan) {
  for (const std::size_t turn : {0, 1, 2}) {
    TriangleMesh mesh = tetrahedron_with_a_flat_triangle(0.0);
    for (auto& t : mesh.triangles) std::rotate(t.begin(), t.begin() + turn, t.end());
    weld(mesh);
    EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{2, 1, 4}));
    EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 4}));
  }
}

// The diagonal of two flat triangles is too short to be an edge.
TEST(Weld, TwoFlatTrianglesGoAndTheirCornersBecomeOne) {
  TriangleMesh mesh = mesh_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {2, 0.0002, 0}, {2, 0, 0.0002}},
                              {{0, 4, 1}, {0, 1, 5}, {0, 2, 4}, {4, 2, 1}, {0, 5, 3}, {5, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  ASSERT_EQ(euler_if_closed(mesh), 2);
  const Welding made = weld(mesh);
  EXPECT_EQ(made.joined, 1u);
  EXPECT_EQ(made.flat, 0u);
  EXPECT_EQ(made.into, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 4}));
  EXPECT_EQ(mesh.triangles.size(), 6u);
  EXPECT_EQ(euler_if_closed(mesh), 2);
  EXPECT_NEAR(measure(mesh).volume, 32.0 / 3.0, 0.01);
}

// The other diagonal would lie outside the triangle beyond the longest edge, which is thinner than the flat one is far
// off: one of the new triangles would face inwards.
TEST(Weld, AFlatTriangleStaysWhereItsFlipWouldFold) {
  TriangleMesh mesh = mesh_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {1, 0.00049, 0}, {2, 0.0008, 0}},
                              {{0, 5, 1}, {5, 2, 1}, {0, 2, 5}, {0, 1, 4}, {0, 4, 3}, {4, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  ASSERT_EQ(euler_if_closed(mesh), 2);
  const std::vector<std::array<std::uint32_t, 3>> before = mesh.triangles;
  const Welding made = weld(mesh);
  EXPECT_EQ(made.flipped, 0u);
  EXPECT_EQ(made.flat, 1u);
  EXPECT_EQ(mesh.triangles, before);
}

TEST(Weld, WhatHasAnAreaInTheNumbersOfAFileStays) {
  TriangleMesh mesh = tetrahedron_with_a_flat_triangle(0.002);
  EXPECT_EQ(weld(mesh).flipped, 0u);
}

// Where coordinates are large, single precision cannot tell what thousandths can.
TEST(Weld, TrianglesWithoutAreaInSinglePrecisionGo) {
  TriangleMesh mesh = tetrahedron_with_a_flat_triangle(0.002);
  for (glm::dvec3& x : mesh.positions) x += glm::dvec3(1e6);
  EXPECT_EQ(weld(mesh).flipped, 1u);
  EXPECT_EQ(euler_if_closed(mesh), 2);
}

// Triangles do not go around it once: an edge there could vanish on one side only.
TEST(Weld, AVertexOfTwoPartsStays) {
  TriangleMesh mesh = octahedron_with_a_double_corner(0.0004);
  const std::vector<glm::dvec3> more{{1, 0, 2}, {0, 1, 2}, {-1, -1, 2}};
  mesh.positions.insert(mesh.positions.end(), more.begin(), more.end());
  std::vector<std::array<std::uint32_t, 3>> triangles{{0, 8, 7}, {0, 9, 8}, {0, 7, 9}, {7, 8, 9}};
  triangles.insert(triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  mesh = mesh_of(mesh.positions, triangles);
  EXPECT_TRUE(measure(mesh).closed);
  EXPECT_EQ(weld(mesh).joined, 0u);
  EXPECT_EQ(mesh.triangles, triangles);
}

}  // namespace
}  // namespace meniscus
