// SPDX-License-Identifier: BSD-3-Clause
// Half-borders become loops, faces and areas: small cases with a known answer.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/surface/boundary.h"
#include "core/surface/spherical.h"

namespace meniscus::testing {
namespace {

/// Returns a circle of latitude of the unit sphere, counter-clockwise about z: the north lies on its left.
Border latitude(double z) {
  Border border;
  border.center = {0, 0, z};
  border.axis = {0, 0, 1};
  border.radius = std::sqrt(1 - z * z);
  border.start = {1, 0, 0};
  border.sweep = 2 * std::numbers::pi;
  return border;
}

std::vector<Border> latitudes(std::initializer_list<double> heights) {
  std::vector<Border> borders;
  for (const double z : heights) borders.push_back(latitude(z));
  return borders;
}

constexpr HalfBorder north_of(std::uint32_t border) { return 2 * border; }
constexpr HalfBorder south_of(std::uint32_t border) { return 2 * border + 1; }

PatchFaces faces_of(const std::vector<Border>& borders, const std::vector<HalfBorder>& walk) {
  return LoopChainer().chain(borders, walk, glm::dvec3(0.0), 1.0, false);
}

TEST(Loops, WholeCirclesBoundBandsAndCaps) {
  const std::vector<Border> two = latitudes({0.5, -0.5});
  const PatchFaces band = faces_of(two, {south_of(0), north_of(1)});
  EXPECT_TRUE(band.closed);
  EXPECT_EQ(band.face_count, 1u);
  const PatchFaces caps = faces_of(two, {north_of(0), south_of(1)});
  EXPECT_EQ(caps.face_count, 2u);
  EXPECT_NE(caps.loop_face[0], caps.loop_face[1]);
}

TEST(Loops, ThatOthersPartBoundDifferentFaces) {
  // Two bands: the outermost loops see each other on their left, but the two between them part them.
  const std::vector<Border> four = latitudes({0.8, 0.3, -0.3, -0.8});
  const PatchFaces bands = faces_of(four, {south_of(0), north_of(1), south_of(2), north_of(3)});
  ASSERT_EQ(bands.loop_face.size(), 4u);
  EXPECT_EQ(bands.face_count, 2u);
  std::vector<std::uint32_t> face_of_circle(4);
  for (std::size_t l = 0; l < 4; ++l) face_of_circle[bands.half_borders[l] / 2] = bands.loop_face[l];
  EXPECT_EQ(face_of_circle[0], face_of_circle[1]);
  EXPECT_EQ(face_of_circle[2], face_of_circle[3]);
  EXPECT_NE(face_of_circle[0], face_of_circle[3]);
}

TEST(Loops, AWalkThatDoesNotReturnIsOpen) {
  std::vector<Border> arcs = latitudes({0.2, 0.2, 0.2});
  for (std::uint32_t n = 0; n < 3; ++n) {
    arcs[n].sweep = 2 * std::numbers::pi / 3;
    arcs[n].start = {std::cos(n * arcs[n].sweep), std::sin(n * arcs[n].sweep), 0};
    arcs[n].vertex = {n, (n + 1) % 3};
  }
  const PatchFaces whole = faces_of(arcs, {north_of(0), north_of(1), north_of(2)});
  EXPECT_TRUE(whole.closed);
  EXPECT_EQ(whole.loop_sizes, std::vector<std::uint32_t>{3});
  EXPECT_FALSE(faces_of(arcs, {north_of(0), north_of(1)}).closed);
  EXPECT_FALSE(faces_of(arcs, {north_of(0), south_of(1), north_of(2)}).closed);
}

TEST(Loops, NoBordersAreAWholeSphereOrNothing) {
  LoopChainer chainer;
  EXPECT_EQ(chainer.chain({}, {}, glm::dvec3(0.0), 1.0, false).face_count, 1u);
  EXPECT_EQ(chainer.chain({}, {}, glm::dvec3(0.0), 1.0, true).face_count, 0u);
}

TEST(Loops, NothingOfOnePatchStaysForTheNext) {
  LoopChainer chainer;
  const std::vector<Border> four = latitudes({0.8, 0.3, -0.3, -0.8});
  const std::vector<HalfBorder> bands{south_of(0), north_of(1), south_of(2), north_of(3)}, cap{north_of(0)};
  std::vector<Border> open = latitudes({0.2});
  open[0].vertex = {0, 1};
  EXPECT_EQ(chainer.chain(four, bands, glm::dvec3(0.0), 1.0, false).face_count, 2u);
  EXPECT_FALSE(chainer.chain(open, cap, glm::dvec3(0.0), 1.0, false).closed);
  const PatchFaces& alone = chainer.chain(four, cap, glm::dvec3(0.0), 1.0, false);
  EXPECT_TRUE(alone.closed);
  EXPECT_EQ(alone.face_count, 1u);
  EXPECT_EQ(alone.half_borders, cap);
  EXPECT_EQ(alone.loop_sizes, std::vector<std::uint32_t>{1});
}

// Where a loop turns back on itself the turn is half a turn to the left, whatever sign rounding gives it.
TEST(Loops, ALuneWithoutWidthHasNoArea) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    const double x = normal(random), y = normal(random), z = normal(random);
    return glm::normalize(glm::dvec3(x, y, z));
  };
  for (int n = 0; n < 200; ++n) {
    const glm::dvec3 a = direction(), b = direction(), axis = glm::normalize(glm::cross(a, b));
    const double sweep = std::acos(glm::dot(a, b));
    const SphereArc there{axis, 0.0, a, b, sweep, false};
    const SphereArc back{glm::normalize(axis + 1e-15 * direction()), 0.0, b, a, -sweep, false};
    const double area = area_left_of(std::vector<SphereArc>{there, back});
    EXPECT_LT(std::min(std::abs(area), std::abs(4 * std::numbers::pi - area)), 1e-6)
        << "all but nothing, or all but everything";
  }
}

}  // namespace
}  // namespace meniscus::testing
