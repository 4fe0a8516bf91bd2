// SPDX-License-Identifier: BSD-3-Clause
// Welding: short edges go where the mesh stays a closed surface of the same genus, and nowhere else.
#include "exporters/msms/weld.h"

#include <map>
#include <utility>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

MsmsMesh mesh_of(std::vector<glm::dvec3> points, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  MsmsMesh mesh;
  for (const glm::dvec3& x : points) mesh.vertices.push_back({x, {0, 0, 1}, 0, 0, 2});
  for (const auto& t : triangles) mesh.triangles.push_back({t, MsmsFaceKind::contact, 1});
  return mesh;
}

int euler_if_closed(const MsmsMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const MsmsTriangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t.corner[k], t.corner[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  return static_cast<int>(mesh.vertices.size() + mesh.triangles.size() - edges.size() / 2);
}

// An octahedron whose upper corner is two, so near together that they are one.
MsmsMesh octahedron_with_a_double_corner(double apart) {
  return mesh_of(
      {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {apart, 0, 1}},
      {{6, 1, 2}, {6, 2, 0}, {0, 2, 3}, {0, 3, 4}, {0, 4, 6}, {6, 4, 1}, {2, 1, 5}, {3, 2, 5}, {4, 3, 5}, {1, 4, 5}});
}

TEST(Weld, TwoVerticesOnePointBecomeOneAndTheLowerStays) {
  MsmsMesh mesh = octahedron_with_a_double_corner(0.0004);
  ASSERT_EQ(euler_if_closed(mesh), 2);
  weld_short_edges(mesh, 0.001);
  EXPECT_EQ(mesh.vertices.size(), 6u);
  EXPECT_EQ(mesh.triangles.size(), 8u);
  EXPECT_EQ(euler_if_closed(mesh), 2);
  EXPECT_EQ(mesh.vertices[0].position.x, 0.0);
}

TEST(Weld, LongerEdgesStay) {
  MsmsMesh mesh = octahedron_with_a_double_corner(0.01);
  weld_short_edges(mesh, 0.001);
  EXPECT_EQ(mesh.vertices.size(), 7u);
}

// A tetrahedron has no edge that could go: what is left would be two triangles back to back.
TEST(Weld, ATetrahedronStays) {
  MsmsMesh mesh =
      mesh_of({{0, 0, 0}, {0.0001, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  weld_short_edges(mesh, 0.001);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(euler_if_closed(mesh), 2);
}

// Round the neck of a double pyramid with three sides: without one of its edges it would be pinched there.
TEST(Weld, ANeckStays) {
  MsmsMesh mesh = mesh_of({{0, 0, 1}, {0.0002, 0, 0}, {0, 0.0002, 0}, {-1, -1, 0}, {0, 0, -1}},
                          {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {2, 1, 4}, {3, 2, 4}, {1, 3, 4}});
  weld_short_edges(mesh, 0.001);
  EXPECT_EQ(mesh.vertices.size(), 5u);  // 1 and 2 have three common neighbours
  EXPECT_EQ(euler_if_closed(mesh), 2);
}

}  // namespace
}  // namespace meniscus
