// SPDX-License-Identifier: BSD-3-Clause
// Regions on the unit sphere: areas from almost nothing to almost everything, moments, and sides of loops.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/surface/spherical.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

SphereArc great_arc(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 normal = glm::cross(a, b);
  return {glm::normalize(normal), 0.0, a, b, std::atan2(glm::length(normal), glm::dot(a, b)), false};
}

// Returns a regular polygon of great-circle arcs around the z axis, turned at random.
std::vector<SphereArc> polygon(int corners, double polar_angle, const glm::dmat3& turn) {
  std::vector<glm::dvec3> points;
  for (int n = 0; n < corners; ++n) {
    const double angle = 2 * kPi * n / corners;
    points.push_back(turn * glm::dvec3(std::sin(polar_angle) * std::cos(angle), std::sin(polar_angle) * std::sin(angle),
                                       std::cos(polar_angle)));
  }
  std::vector<SphereArc> loop;
  loop.reserve(points.size());
  for (int n = 0; n < corners; ++n) loop.push_back(great_arc(points[n], points[(n + 1) % corners]));
  return loop;
}

std::vector<SphereArc> backwards(std::vector<SphereArc> loop) {
  std::reverse(loop.begin(), loop.end());
  for (SphereArc& arc : loop) {
    std::swap(arc.from, arc.to);
    arc.sweep = -arc.sweep;
  }
  return loop;
}

// Returns Girard's area by the sum of the interior angles, each 2 asin(cos(pi/n) / cos(half the side)).
double polygon_area(int corners, double polar_angle) {
  const double half_side = std::asin(std::sin(polar_angle) * std::sin(kPi / corners));
  return corners * 2 * std::asin(std::cos(kPi / corners) / std::cos(half_side)) - (corners - 2) * kPi;
}

TEST(Area, OfPolygonsFromDotsToHemispheres) {
  std::mt19937 random(1);
  for (const int corners : {3, 4, 7})
    for (double size = 1.5; size > 1e-10; size /= 3)
      for (int n = 0; n < 20; ++n) {
        const std::vector<SphereArc> loop = polygon(corners, size, random_rotation(random));
        const double area = polygon_area(corners, size);
        EXPECT_NEAR(area_left_of(loop), area, 1e-13) << corners << " corners, size " << size;
      }
}

// Left of a clockwise walk round two overlapping small caps lies all the rest of the sphere.
TEST(Area, OfAllTheRestOfTheSphere) {
  std::mt19937 random(2);
  for (double size = 1e-2; size > 1e-6; size /= 3)
    for (int n = 0; n < 20; ++n) {
      const glm::dmat3 turn = random_rotation(random);
      const double height = std::cos(size), tilt = 0.6 * size;
      // Where the caps' circles meet, without cancellation.
      const double z = height / std::cos(tilt);
      const double y = std::sqrt(std::pow(std::sin(size), 2) - std::pow(std::sin(tilt), 2)) / std::cos(tilt);
      std::vector<SphereArc> loop;
      for (const double side : {1.0, -1.0}) {
        const glm::dvec3 axis = turn * glm::dvec3(side * std::sin(tilt), 0, std::cos(tilt));
        const glm::dvec3 from = turn * glm::dvec3(0, side * y, z), to = turn * glm::dvec3(0, -side * y, z);
        const double half = std::atan2(y, z * std::sin(tilt));
        loop.push_back({axis, height, from, to, -(2 * kPi - 2 * half), false});
      }
      EXPECT_NEAR(area_left_of(loop), 4 * kPi, 10 * size * size + 1e-7) << size;
    }
}

TEST(Area, OfCaps) {
  for (const double height : {-1.0, -0.999999999, -0.3, 0.0, 0.7, 1.0})
    for (const double sweep : {2 * kPi, -2 * kPi}) {
      const double s = std::sqrt(1 - height * height);
      const glm::dvec3 start(s, 0, height);
      const std::vector<SphereArc> loop{{{0, 0, 1}, height, start, start, sweep, true}};
      const double cap = 2 * kPi * (1 - height);
      EXPECT_NEAR(area_left_of(loop), sweep > 0 ? cap : 4 * kPi - cap, 1e-12);
      EXPECT_NEAR(moment_left_of(loop).z, (sweep > 0 ? kPi : -kPi) * s * s, 1e-12);
    }
}

// The second closed form, for faces with blurred corners: about any pole, with 4 pi less where the antipode is inside.
TEST(Area, SweptFromAnyPole) {
  std::mt19937 random(4);
  for (const int corners : {3, 4, 7})
    for (double size = 1.5; size > 1e-10; size /= 3)
      for (int n = 0; n < 20; ++n) {
        const glm::dmat3 turn = random_rotation(random);
        const std::vector<SphereArc> loop = polygon(corners, size, turn);
        const glm::dvec3 middle = turn[2], pole = random_rotation(random)[0];
        const double area = polygon_area(corners, size);
        EXPECT_NEAR(area_swept_from(middle, loop), area, 1e-13);
        if (size > 1e-3) {
          EXPECT_NEAR(area_swept_from(-middle, loop), area - 4 * kPi, 1e-9);
        }
        if (glm::dot(pole, middle) < 0) continue;  // the antipode may be inside
        EXPECT_NEAR(area_swept_from(pole, loop), area, 1e-13) << corners << " corners, size " << size;
        EXPECT_NEAR(area_swept_from(pole, backwards(loop)), -area, 1e-13);
      }
}

// Arcs that end a little past or before the corner, as those of planes that are nearly parallel do: areas and moments
// change by the square of the step. (By the step itself, areas of atoms did not add up to the surface's.)
TEST(Area, OfLoopsThatDoNotQuiteClose) {
  std::mt19937 random(6);
  for (const int corners : {3, 4, 7})
    for (double step = 1e-4; step > 1e-11; step /= 10) {
      const glm::dmat3 turn = random_rotation(random);
      const std::vector<SphereArc> closed = polygon(corners, 0.4, turn);
      std::vector<SphereArc> loop = closed;
      for (std::size_t n = 0; n < loop.size(); n += 2) {
        const double past = n % 4 == 0 ? step : -0.7 * step;
        loop[n].to = std::cos(past) * loop[n].to + std::sin(past) * glm::cross(loop[n].axis, loop[n].to);
        loop[n].sweep += past;
      }
      const double area = polygon_area(corners, 0.4), noise = 8 * step * step + 1e-13;
      EXPECT_GT(misfit_of(loop), 0.5 * step);
      EXPECT_NEAR(area_left_of(loop), area, noise) << step;
      EXPECT_NEAR(area_swept_from(glm::normalize(turn[2] + 0.3 * turn[0]), loop), area, noise) << step;
      EXPECT_NEAR(glm::distance(moment_left_of(loop) + moment_of_steps(loop), moment_left_of(closed)), 0, noise)
          << step;
    }
}

// Corners beside their circles by more than these are wide: the turning is lost, the swept area is not.
TEST(Area, OfATinyCapWithABlurredCorner) {
  const double size = 1e-7, height = std::cos(size);
  const glm::dvec3 from(size, 0, height), beside(1.3 * size, 0.4 * size, height);
  const std::vector<SphereArc> loop{{{0, 0, 1}, height, from, beside, 2 * kPi, false}};
  EXPECT_GT(misfit_of(loop), 0.1);
  EXPECT_NEAR(area_swept_from({0.6, 0, 0.8}, loop), kPi * size * size, 1e-6);
}

// Two circles that touch in a point, and an arc without length of the second: walked either way it adds no turning.
// (Its direction was lost with the sign of its sweep, and the area was off by half a sphere.)
TEST(Area, OfACapWithAnArcWithoutLength) {
  const double size = 0.9, small = 0.4;
  const glm::dvec3 touching(std::sin(size), 0, std::cos(size)), wide(0, 0, 1);
  const glm::dvec3 narrow(std::sin(size - small), 0, std::cos(size - small));
  const double cap = 2 * kPi * (1 - std::cos(size));
  for (const double sign : {1.0, -1.0}) {
    const std::vector<SphereArc> loop{{wide, std::cos(size), touching, touching, sign * 2 * kPi, false},
                                      {narrow, std::cos(small), touching, touching, sign * 0.0, false}};
    EXPECT_NEAR(area_left_of(loop), sign > 0 ? cap : 4 * kPi - cap, 1e-12) << sign;
    EXPECT_EQ(shortest_of(loop), 0.0);
    EXPECT_NEAR(area_swept_from(sign * wide, loop), sign > 0 ? cap : 4 * kPi - cap, 1e-12);
  }
}

TEST(Area, OfCapsSweptFromAnyPole) {
  std::mt19937 random(5);
  for (const double height : {-0.999999999, -0.3, 0.0, 0.7, 0.999999999})
    for (const double sweep : {2 * kPi, -2 * kPi})
      for (int n = 0; n < 50; ++n) {
        const double s = std::sqrt(1 - height * height);
        const glm::dvec3 start(s, 0, height), pole = random_rotation(random)[0];
        const std::vector<SphereArc> loop{{{0, 0, 1}, height, start, start, sweep, true}};
        const bool antipode_in_cap = -pole.z > height, antipode_inside = antipode_in_cap == (sweep > 0);
        const double cap = 2 * kPi * (1 - height), area = sweep > 0 ? cap : 4 * kPi - cap;
        EXPECT_NEAR(area_swept_from(pole, loop), antipode_inside ? area - 4 * kPi : area, 1e-6);
      }
}

TEST(Moment, IsTheIntegralOfDirections) {
  // Octant: the integral of u over it is pi/4 (1, 1, 1).
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const std::vector<SphereArc> octant{great_arc(x, y), great_arc(y, z), great_arc(z, x)};
  EXPECT_NEAR(area_left_of(octant), kPi / 2, 1e-14);
  EXPECT_NEAR(glm::distance(moment_left_of(octant), glm::dvec3(kPi / 4)), 0, 1e-14);
}

TEST(Sides, OfPolygons) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 2000; ++n) {
    const double size = 0.1 + 1.3 * (n % 100) / 100.0;
    const int corners = 3 + n % 5;
    const std::vector<SphereArc> loop = polygon(corners, size, random_rotation(random));
    const glm::dvec3 point = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    // A convex polygon of great circles: inside means left of every one.
    double depth = 2;
    for (const SphereArc& arc : loop) depth = std::min(depth, glm::dot(arc.axis, point));
    if (std::abs(depth) < 1e-9) continue;
    EXPECT_EQ(distance_left_of(point, loop) > 0, depth > 0);
  }
}

TEST(Sides, PointsThatLookAtACornerOrThroughIt) {
  // All symmetric positions: the way from the point to the middle of an arc leads through corners.
  const std::vector<SphereArc> loop = polygon(4, 0.5, glm::dmat3(1.0));
  for (int n = 0; n < 8; ++n)
    for (const double polar : {0.0, 0.2, 0.45, 0.55, 1.0, 2.0, 3.0}) {
      const double angle = kPi * n / 4;
      const glm::dvec3 point(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar));
      const double reach = n % 2 ? std::atan(std::tan(0.5) * std::cos(kPi / 4)) : 0.5;
      EXPECT_EQ(distance_left_of(point, loop) > 0, polar < reach) << n << ' ' << polar;
    }
}

// The equator in five arcs: rounding decides whether an arc's end is nearest, where tangents tell no side.
TEST(Sides, PointsBesideAVertexThatIsNoCorner) {
  std::mt19937 random(6);
  for (int n = 0; n < 200; ++n) {
    const glm::dmat3 turn = random_rotation(random);
    const std::vector<SphereArc> loop = polygon(5, kPi / 2, turn);
    for (const SphereArc& arc : loop)
      for (const double north : {0.3, -0.3, 1e-3, -1e-3})
        EXPECT_EQ(distance_left_of(std::cos(north) * arc.to + std::sin(north) * turn[2], loop) > 0, north > 0);
  }
}

TEST(Sides, LoopsThatTouch) {
  // A circle that touches one side of an octant from inside: it lies left of it, wherever its points are asked.
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const std::vector<SphereArc> octant{great_arc(x, y), great_arc(y, z), great_arc(z, x)};
  const glm::dvec3 center = glm::normalize(glm::dvec3(1, 1, 0.4));
  const double height = std::sqrt(1 - center.z * center.z);  // as far from the centre as the side in the plane z = 0
  const glm::dvec3 touching = glm::normalize(glm::dvec3(1, 1, 0));
  const glm::dvec3 opposite = 2 * height * center - touching;
  for (const glm::dvec3& start : {touching, opposite}) {
    const std::vector<SphereArc> circle{{center, height, start, start, 2 * kPi, true}};
    EXPECT_TRUE(lies_left_of(circle, octant));
    EXPECT_FALSE(lies_left_of(octant, circle));
    EXPECT_TRUE(lies_left_of(octant, backwards(circle)));
  }
}

}  // namespace
}  // namespace meniscus::testing
