// SPDX-License-Identifier: BSD-3-Clause
// The exact planar triangulation: Delaunay by brute force, constraints kept, conflicts named; and the sphere lattice.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/mesh/face_mesh.h"
#include "core/mesh/planar_triangulation.h"

namespace meniscus {
namespace {

std::vector<GridPoint> random_points(int count, std::int64_t limit, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::int64_t> at(-limit, limit);
  std::vector<GridPoint> points(count);
  for (auto& p : points) p = {at(random), at(random)};
  return points;
}

// What llround() makes of a point that is not a number; before this was refused flips went on for ever.
TEST(PlanarTriangulation, RefusesPointsOffTheGrid) {
  for (const GridPoint point :
       {GridPoint{INT64_MIN, INT64_MIN}, GridPoint{0, kGridLimit + 1}, GridPoint{INT64_MAX, 0}}) {
    PlanarTriangulation plane;
    plane.insert({5, 7});
    EXPECT_THROW(plane.insert(point), OpenSurfaceError);
  }
}

TEST(PlanarTriangulation, IsDelaunayEvenOnACoarseGridFullOfTies) {
  for (const std::int64_t limit : {std::int64_t{6}, std::int64_t{1000}, kGridLimit}) {
    PlanarTriangulation plane;
    for (const GridPoint& p : random_points(120, limit, 7)) plane.insert(p);
    const auto& points = plane.points();
    for (const auto& t : plane.triangles()) {
      const GridPoint a = points[t.vertex[0]], b = points[t.vertex[1]], c = points[t.vertex[2]];
      ASSERT_GT(orientation(a, b, c), 0);
      for (const GridPoint& p : points) ASSERT_FALSE(inside_circle(a, b, c, p));
    }
  }
}

TEST(PlanarTriangulation, AnExistingPointIsFoundAgain) {
  PlanarTriangulation plane;
  const auto first = plane.insert({3, 4});
  EXPECT_EQ(plane.insert({3, 4}), first);
}

TEST(PlanarTriangulation, AStarPolygonKeepsItsEdgesAndItsArea) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> reach(0.05, 1.0);
    const int n = 60;
    PlanarTriangulation plane;
    std::vector<int> corner;
    std::int64_t doubled_area = 0;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n, r = reach(random) * 1e6;
      corner.push_back(*plane.insert({std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle))}));
    }
    std::vector<std::array<int, 2>> edges;
    for (int i = 0; i < n; ++i) {
      const int a = corner[i], b = corner[(i + 1) % n];
      ASSERT_FALSE(plane.constrain(a, b, i).has_value());
      edges.push_back({a, b});
      doubled_area += plane.points()[a].x * plane.points()[b].y - plane.points()[a].y * plane.points()[b].x;
    }
    for (const GridPoint& p : random_points(40, 1000000, seed)) plane.insert(p);
    ASSERT_TRUE(plane.fill(edges));
    std::int64_t filled = 0;
    std::set<std::array<int, 2>> rim;
    for (const auto& t : plane.triangles()) {
      if (!t.inside) continue;
      const auto& p = plane.points();
      filled += orientation(p[t.vertex[0]], p[t.vertex[1]], p[t.vertex[2]]);
      for (int k = 0; k < 3; ++k) {
        if (t.segment[k] >= 0) rim.insert({t.vertex[(k + 1) % 3], t.vertex[(k + 2) % 3]});
      }
    }
    EXPECT_EQ(filled, doubled_area);
    EXPECT_EQ(rim, std::set(edges.begin(), edges.end()));
  }
}

TEST(PlanarTriangulation, ConflictsAreNamed) {
  PlanarTriangulation plane;
  const int a = *plane.insert({-10, 0}), b = *plane.insert({10, 0}), c = *plane.insert({0, -10}),
            d = *plane.insert({0, 10}), e = *plane.insert({5, 5});
  ASSERT_FALSE(plane.constrain(a, b, 4).has_value());
  const auto crossing = plane.constrain(c, d, 5);
  ASSERT_TRUE(crossing.has_value());
  EXPECT_EQ(crossing->segment, 4);
  const int f = *plane.insert({10, 10});
  const int g = *plane.insert({2, 2});
  const auto through = plane.constrain(g, f, 6);
  ASSERT_TRUE(through.has_value());
  EXPECT_EQ(through->vertex, e);
  EXPECT_FALSE(plane.insert({1, 0}).has_value()) << "a point on a constrained edge";
}

TEST(SphereLattice, IsASphereWithEdgesAsShortAsAsked) {
  for (const double angle : {1.2, 0.5, 0.21, 0.05}) {
    const SphereLattice lattice = sphere_lattice(lattice_frequency(angle));
    const auto v = lattice.directions.size(), t = lattice.triangles.size();
    EXPECT_EQ(v + t, t * 3 / 2 + 2);
    double longest = 0.0, area = 0.0;
    for (const auto& triangle : lattice.triangles) {
      const glm::dvec3 a = lattice.directions[triangle[0]], b = lattice.directions[triangle[1]],
                       c = lattice.directions[triangle[2]];
      EXPECT_GT(glm::dot(a, glm::cross(b, c)), 0.0);
      longest = std::max({longest, std::acos(glm::dot(a, b)), std::acos(glm::dot(b, c)), std::acos(glm::dot(c, a))});
      area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    EXPECT_LE(longest, angle + 1e-12);
    EXPECT_GT(longest, 0.6 * std::min(angle, 1.1));
    EXPECT_NEAR(area, 4 * std::numbers::pi, 4 * std::numbers::pi * 0.2 * angle * angle);
  }
}

}  // namespace
}  // namespace meniscus
