// SPDX-License-Identifier: BSD-3-Clause
// Faces with blurred corners: their areas are those about a pole, and disagreements with Gauss-Bonnet are reported.
#include "core/surface/measure.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace meniscus {
namespace {

constexpr double kPi = std::numbers::pi;

/// Returns one face of the unit sphere to the left of a loop, and the half-spaces that keep it.
Surface face_of(const std::vector<Border>& loop, const std::vector<Plane>& planes) {
  Surface surface;
  surface.probe_radius = 1.4;
  surface.atoms = {{{0, 0, 0}, 1}};
  surface.planes = planes;
  surface.convex = {{0, 0, static_cast<std::uint32_t>(planes.size()), 0, 1}};
  const auto count = static_cast<std::uint32_t>(loop.size());
  for (std::uint32_t n = 0; n < count; ++n) {
    surface.borders.push_back(loop[n]);
    surface.borders.back().vertex = {n, (n + 1) % count};
    surface.borders.back().face = {0, kNone};
    surface.half_borders.push_back(2 * n);
  }
  surface.loops = {{0, count}};
  surface.faces.push_back({PatchKind::convex, 0, 0, 1});
  surface.components.emplace_back();
  return surface;
}

/// Returns the polygon of great-circle arcs through points of the plane z = 1, seen from the middle of the sphere.
std::vector<Border> polygon(const std::vector<glm::dvec2>& points) {
  std::vector<Border> loop;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const glm::dvec2 to = points[(n + 1) % points.size()];
    const glm::dvec3 a = glm::normalize(glm::dvec3(points[n], 1)), b = glm::normalize(glm::dvec3(to, 1));
    const glm::dvec3 normal = glm::cross(a, b);
    loop.push_back({.axis = glm::normalize(normal),
                    .radius = 1,
                    .start = a,
                    .sweep = std::atan2(glm::length(normal), glm::dot(a, b))});
  }
  return loop;
}

/// Returns a circle of that angular radius around the z axis that ends next to its beginning, by 0.4 of its radius.
Border unclosed_circle(double size, double direction) {
  return {.center = {0, 0, std::cos(size)},
          .axis = {0, 0, direction},
          .radius = std::sin(size),
          .start = {1, 0, 0},
          .sweep = 2 * kPi - 0.4};
}

const Plane kUpperHalf{{0, 0, -1}, 0};

TEST(BlurredFaces, HaveTheAreaThatTheirCornersHide) {
  for (const double size : {1e-4, 1e-7}) {
    Surface dot = face_of({unclosed_circle(size, 1)}, {{{0, 0, -1}, -std::cos(size)}});
    EXPECT_EQ(measure_surface(dot).doubtful, std::vector<std::uint32_t>{0});
    EXPECT_NEAR(dot.area, 0, 4 * size * size);
    EXPECT_GE(dot.area, 0);
    Surface rest = face_of({unclosed_circle(size, -1)}, {{{0, 0, 1}, std::cos(size)}});
    EXPECT_EQ(measure_surface(rest).doubtful, std::vector<std::uint32_t>{0});
    EXPECT_NEAR(rest.area, 4 * kPi, 4 * size * size);
    EXPECT_LE(rest.area, 4 * kPi);
  }
}

TEST(BlurredFaces, AreDoubtfulFromABlurOf1e9OnAndRightAllTheSame) {
  const std::vector<glm::dvec2> square{{0.2, 0.2}, {-0.2, 0.2}, {-0.2, -0.2}, {0.2, -0.2}};
  Surface sharp = face_of(polygon(square), {kUpperHalf});
  const MeasurementDoubts none = measure_surface(sharp);
  EXPECT_TRUE(none.doubtful.empty() && none.disputed.empty());
  for (const auto& [blur, doubtful] : {std::pair{1e-10, false}, {1e-8, true}, {1e-4, true}}) {
    std::vector<Border> loop = polygon(square);
    loop[1].sweep += blur;
    Surface blurred = face_of(loop, {kUpperHalf});
    const MeasurementDoubts doubts = measure_surface(blurred);
    EXPECT_EQ(!doubts.doubtful.empty(), doubtful) << blur;
    EXPECT_TRUE(doubts.disputed.empty()) << blur;
    EXPECT_NEAR(blurred.area, sharp.area, blur);
  }
}

// At a corner of more than 3/2 pi, which no patch has, the turning is off by a whole turn: an area about a pole is not.
TEST(BlurredFaces, AreDisputedWhereTheTwoFormsDiffer) {
  std::vector<Border> dart = polygon({{0, 0.2}, {-0.2, -0.2}, {0, 0.16}, {0.2, -0.2}});
  dart[0].sweep += 1e-8;
  Surface surface = face_of(dart, {kUpperHalf});
  EXPECT_EQ(measure_surface(surface).disputed, std::vector<std::uint32_t>{0});
  EXPECT_NEAR(surface.area, 0.008, 0.0005);
}

}  // namespace
}  // namespace meniscus
