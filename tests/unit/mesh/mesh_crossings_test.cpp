// SPDX-License-Identifier: BSD-3-Clause
// Triangles that pass through one another are found in a whole mesh, and in a change that is watched.
#include "core/mesh/mesh_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include "core/mesh/half_edges.h"
#include "core/math/ball.h"

namespace meniscus::testing {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

TEST(MeshCrossings, AreFoundWhereTwoTetrahedraOverlap) {
  const std::vector<Triangle> one{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  std::vector<glm::dvec3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_TRUE(crossing_triangles(x, one).empty());
  std::vector<Triangle> both = one;
  for (const Triangle& t : one) both.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
  for (const double shift : {0.1, 2.0}) {
    std::vector<glm::dvec3> all = x;
    for (int k = 0; k < 4; ++k) all.push_back(x[k] + glm::dvec3(shift, 0.11 * shift, 0.13 * shift));
    EXPECT_EQ(crossing_triangles(all, both).empty(), shift == 2.0);
  }
}

TEST(MeshCrossings, AreFoundAtASharedVertex) {
  const std::vector<glm::dvec3> x{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 0.2, -1}, {0.4, 0.8, 1}};
  EXPECT_EQ(crossing_triangles(x, std::vector<Triangle>{{0, 1, 2}, {0, 3, 4}}).size(), 1u);
  const std::vector<glm::dvec3> y{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 0.2, 1}, {0.4, 0.8, 1}};
  EXPECT_TRUE(crossing_triangles(y, std::vector<Triangle>{{0, 1, 2}, {0, 3, 4}}).empty());
}

// Small and large triangles, which reach over many cells, give each pair once and in ascending order.
TEST(MeshCrossings, AreThoseOfAllPairs) {
  std::vector<glm::dvec3> x;
  std::vector<Triangle> triangles;
  std::uint64_t state = 7;
  const auto random = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 11) / 9007199254740992.0 - 0.5;
  };
  for (std::uint32_t t = 0; t < 400; ++t) {
    const double size = t % 50 == 0 ? 12.0 : 2.5;
    const glm::dvec3 middle(10.0 * random(), 10.0 * random(), 10.0 * random());
    for (int k = 0; k < 3; ++k) x.push_back(middle + size * glm::dvec3(random(), random(), random()));
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const auto placed = [&](std::uint32_t t) {
    return PlacedTriangle{triangles[t], {x[3 * t], x[3 * t + 1], x[3 * t + 2]}};
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
  for (std::uint32_t a = 0; a < triangles.size(); ++a)
    for (std::uint32_t b = a + 1; b < triangles.size(); ++b)
      if (triangles_cross(placed(a), placed(b))) expected.emplace_back(a, b);
  EXPECT_GT(expected.size(), 50u);
  EXPECT_EQ(crossing_triangles(x, triangles), expected);
  const std::vector<std::uint32_t> some{3, 50, 51, 200};  // Triangle 50 is large.
  std::erase_if(expected, [&](const auto& pair) {
    return std::ranges::find(some, pair.first) == some.end() && std::ranges::find(some, pair.second) == some.end();
  });
  EXPECT_GT(expected.size(), 3u);
  EXPECT_EQ(crossings_of(some, x, triangles), expected);
}

/// Returns two pyramids over `corners` points that go around an axis `turns` times; the tips are the last vertices.
std::pair<std::vector<glm::dvec3>, std::vector<Triangle>> double_pyramid(std::uint32_t corners, std::uint32_t turns) {
  std::vector<glm::dvec3> x;
  std::vector<Triangle> triangles;
  for (std::uint32_t k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * turns * k / corners;
    x.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    triangles.push_back({k, (k + 1) % corners, corners});
    triangles.push_back({(k + 1) % corners, k, corners + 1});
  }
  x.emplace_back(0.0, 0.0, 0.6);
  x.emplace_back(0.0, 0.0, -0.6);
  return {x, triangles};
}

TEST(FlatFans, GoAroundOnceAndLookOneWay) {
  const auto flat = [](std::vector<glm::dvec3> x, const std::vector<Triangle>& triangles) {
    return flat_fans(HalfEdges(triangles, static_cast<std::uint32_t>(x.size())), x);
  };
  const auto [x, triangles] = double_pyramid(7, 1);
  EXPECT_EQ(flat(x, triangles)[7], 1);
  auto bent = x;
  bent[7].z = 40.0;  // a needle
  EXPECT_EQ(flat(bent, triangles)[7], 0);
  bent = x;
  bent[7].x = 3.0;  // The tip is next to its base.
  EXPECT_EQ(flat(bent, triangles)[7], 0);
  const auto [star, twice] = double_pyramid(7, 2);
  EXPECT_EQ(flat(star, twice)[7], 0);
}

// The vertices of a torus are moved about more and more.
TEST(FlatFans, LeaveNoCrossingOut) {
  constexpr std::uint32_t kLong = 30, kShort = 14;
  std::vector<glm::dvec3> smooth;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < kLong; ++i)
    for (std::uint32_t j = 0; j < kShort; ++j) {
      const double u = 2.0 * std::numbers::pi * i / kLong, v = 2.0 * std::numbers::pi * j / kShort;
      smooth.emplace_back((3.0 + std::cos(v)) * std::cos(u), (3.0 + std::cos(v)) * std::sin(u), std::sin(v));
      const auto at = [](std::uint32_t a, std::uint32_t b) { return a % kLong * kShort + b % kShort; };
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  const HalfEdges links(triangles, static_cast<std::uint32_t>(smooth.size()));
  std::mt19937 random(5);  // NOLINT: the same numbers each time
  std::uniform_real_distribution<double> some(-1.0, 1.0);
  for (const double size : {0.0, 0.1, 0.3, 0.6}) {
    std::vector<glm::dvec3> x = smooth;
    for (glm::dvec3& at : x) at += size * glm::dvec3(some(random), some(random), some(random));
    const std::vector<std::uint8_t> flat = flat_fans(links, x);
    const auto count = std::ranges::count(flat, 1);
    EXPECT_GT(count, 20) << size;
    EXPECT_EQ(count == std::ssize(flat), size < 0.2) << size;
    const auto expected = crossing_triangles(x, triangles);
    EXPECT_EQ(expected.empty(), size < 0.2) << size;
    EXPECT_EQ(crossing_triangles(x, triangles, flat), expected) << size;
  }
}

TEST(CrossingGuard, CountsWhatPassesThroughWatchedTriangles) {
  const std::vector<glm::dvec3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const HalfEdges links(std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 4);
  CrossingGuard guard(links, x);
  const auto crossings = [&](const PlacedTriangle& made, std::vector<std::uint32_t> gone) {
    return guard.crossings({&made, 1}, gone);
  };
  const PlacedTriangle through{{7, 8, 9}, {{{0.2, 0.2, -1}, {0.2, 0.2, 2}, {-3, -3, 0.5}}}};
  const PlacedTriangle beside{{7, 8, 9}, {{{2, 2, -1}, {2, 2, 2}, {3, 3, 0.5}}}};
  EXPECT_EQ(crossings(through, {}), 0u);  // nothing is watched
  guard.guard_around(std::vector<std::uint32_t>{0});
  EXPECT_EQ(crossings(through, {}), 4u);
  EXPECT_EQ(crossings(through, {0}), 3u);
  EXPECT_GE(guard.crossings({&through, 1}, {}, 2), 2u);
  EXPECT_EQ(crossings(beside, {}), 0u);
  guard.release();
  EXPECT_EQ(crossings(through, {}), 0u);
  guard.add(2);
  guard.add(2);  // The triangle is listed twice, counted once.
  EXPECT_EQ(crossings(through, {}), 1u);
  const std::array<PlacedTriangle, 2> both{
      through, PlacedTriangle{{10, 11, 12}, {{{-0.5, -0.6, 0.5}, {-0.62, -0.5, 0.4}, {-0.6, -0.5, 0.6}}}}};
  EXPECT_EQ(guard.crossings(both, std::vector<std::uint32_t>{2}), 1u);  // They cross each other.
}

TEST(CrossingGuard, WatchesVerticesInBallsForGood) {
  const std::vector<glm::dvec3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  HalfEdges links(std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 4);
  CrossingGuard guard(links, x);
  guard.guard_balls(std::vector<Ball>{{{1.1, 0, 0}, 0.2}});
  guard.release();
  for (const std::uint32_t v : {0u, 1u, 2u, 3u}) EXPECT_EQ(guard.is_guarded(v), v == 1) << v;
  guard.add_vertex(1, 2);
  guard.add_vertex(0, 2);
  EXPECT_TRUE(guard.is_guarded(4));
  EXPECT_FALSE(guard.is_guarded(5));
  guard.merge_vertex(1, 3);
  EXPECT_TRUE(guard.is_guarded(3));
}

}  // namespace
}  // namespace meniscus::testing
