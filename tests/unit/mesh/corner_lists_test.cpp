// SPDX-License-Identifier: BSD-3-Clause
// Triangles at vertices are listed for manifolds and for other meshes.
#include "core/mesh/half_edges.h"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace meniscus::testing {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

TEST(CornerLists, AreAscending) {
  const std::vector<Triangle> triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
  const CornerLists corners(triangles, 5);
  EXPECT_EQ(corners.vertex_count(), 5u);
  const auto at = [&](std::uint32_t v) { return std::vector(corners.at(v).begin(), corners.at(v).end()); };
  EXPECT_EQ(at(0), (std::vector<std::uint32_t>{0, 3}));
  EXPECT_EQ(at(1), (std::vector<std::uint32_t>{2, 4, 6}));
  EXPECT_EQ(at(3), (std::vector<std::uint32_t>{5, 8}));
  EXPECT_TRUE(at(4).empty());
}

bool once_around(const std::vector<Triangle>& triangles, std::uint32_t vertex) {
  return is_closed_fan(triangles, CornerLists(triangles, 8).at(vertex));
}

TEST(CornerLists, TellWhetherTrianglesGoAroundAVertexOnce) {
  std::vector<Triangle> triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  for (const std::uint32_t v : {0u, 1u, 2u, 3u}) EXPECT_TRUE(once_around(triangles, v)) << v;
  EXPECT_FALSE(once_around(triangles, 4));
  triangles.insert(triangles.end(), {{3, 5, 4}, {3, 4, 6}, {4, 5, 6}, {5, 3, 6}});  // Another solid shares the tip.
  EXPECT_FALSE(once_around(triangles, 3));
  EXPECT_TRUE(once_around(triangles, 0));
  std::vector<Triangle> fan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  EXPECT_FALSE(once_around(fan, 0));
  fan.push_back({0, 4, 1});
  EXPECT_TRUE(once_around(fan, 0));
}

}  // namespace
}  // namespace meniscus::testing
