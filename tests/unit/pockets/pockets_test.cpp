// SPDX-License-Identifier: BSD-3-Clause
// Pockets of molecules whose hollows are known, and of a protein point by point against the oracle of both probes.
#include "core/pockets/pockets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/base/error.h"
#include "core/math/ball.h"
#include "core/mesh/mesh_objects.h"
#include "core/mesh/triangle_mesh.h"
#include "core/queries/surface_parts.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus::testing {
namespace {

Pockets pockets_of(const Balls& balls, const PocketRequest& request) {
  return find_pockets(balls, request, [](std::span<const Ball> atoms, double probe_radius) {
    return compute_surface_cpu(atoms, probe_radius);
  });
}

PocketRequest all_of_them() {
  PocketRequest request;
  request.min_volume = 0.0;
  return request;
}

double total_volume(const Pockets& found) {
  double sum = 0.0;
  for (const Pocket& pocket : found.pockets) sum += pocket.cavity.volume;
  return sum;
}

double total_excess(const Pockets& found) {
  double sum = 0.0;
  for (const Pocket& pocket : found.pockets) sum += pocket.mouth_area() * found.request.tolerance;
  return sum;
}

/// Returns carbon atoms on a sphere, 1.5 Å apart, without those above `top`.
Balls shell(double radius, double top) {
  const auto count = static_cast<std::size_t>(4 * std::numbers::pi * radius * radius / 2.25);
  Balls balls;
  for (std::size_t n = 0; n < count; ++n) {
    const glm::dvec3 center = radius * spiral_direction(n, count);
    if (center.z < top) balls.push_back({center, kCarbon});
  }
  return balls;
}

/// Returns rings of atoms around the z axis, so close together that nothing gets through the wall.
Balls tube(double radius, int rings) {
  Balls balls;
  const int around = static_cast<int>(std::ceil(2 * std::numbers::pi * radius / 1.5));
  for (int k = 0; k < rings; ++k)
    for (int n = 0; n < around; ++n) {
      const double turn = 2 * std::numbers::pi * (n + 0.5 * (k % 2)) / around;
      balls.push_back({{radius * std::cos(turn), radius * std::sin(turn), 1.3 * k}, kCarbon});
    }
  return balls;
}

TEST(Pockets, AClosedCageHasItsCavityExactly) {
  for (const Balls& balls : {c60(), shell(9.0, 100.0)}) {
    const std::vector<Cavity> cavities = cavities_of(compute_surface_cpu(balls, kWater));
    ASSERT_EQ(cavities.size(), 1u);
    PocketRequest request = all_of_them();
    request.trim = 0.0;
    const Pockets found = pockets_of(balls, request);
    ASSERT_FALSE(found.pockets.empty());
    const Pocket& pocket = found.pockets.front();
    EXPECT_STREQ(pocket.kind(), "cavity");
    EXPECT_NEAR(pocket.cavity.volume, cavities[0].volume, 1e-9 * cavities[0].volume);
    EXPECT_NEAR(pocket.cavity.area, cavities[0].area, 1e-9 * cavities[0].area);
    EXPECT_EQ(pocket.wall_area(), pocket.cavity.area);
    EXPECT_EQ(pocket.cavity.atoms, cavities[0].atoms);
    EXPECT_EQ(PocketLocator(found)({0.1, 0.2, 0.3}), 0u);
  }
}

// The cage is so wide that the large probe fits in: its hull is filled all the same.
TEST(Pockets, WhatFloatsInACavityIsNoPartOfIt) {
  Balls balls = shell(9.0, 100.0);
  const double empty = pockets_of(balls, all_of_them()).pockets.front().cavity.volume;
  balls.push_back({{0.3, 0.2, 0.1}, 2.0});
  balls.push_back({{0.5, 1.2, 0.1}, 1.7});
  const Pockets found = pockets_of(balls, all_of_them());
  const Surface island = compute_surface_cpu(std::span(balls).last(2), kWater);
  const Pocket& pocket = found.pockets.front();
  EXPECT_STREQ(pocket.kind(), "cavity");
  EXPECT_NEAR(pocket.cavity.volume, empty - island.volume, 1e-6);
  EXPECT_EQ(pocket.surface.components.size(), 2u);
  EXPECT_NEAR(pocket.surface.area, pocket.cavity.area, 1e-6);
  EXPECT_TRUE(std::ranges::binary_search(pocket.cavity.atoms, static_cast<std::uint32_t>(balls.size() - 1)));
  const PocketLocator pocket_at(found);
  EXPECT_FALSE(pocket_at({0.3, 0.2, 0.1}).has_value());
  EXPECT_EQ(pocket_at({-4.0, 0.0, 0.0}), 0u);
  EXPECT_FALSE(pocket_at({0.0, 0.0, 30.0}).has_value());
}

// Space around one ball far larger than all others is mostly empty, or deep in that ball. Cell by cell it would take
// weeks to look through.
TEST(Pockets, BesideAHugeBallTakeAsLongAsElsewhere) {
  Balls balls = shell(5.5, 4.4);
  const Pockets alone = pockets_of(balls, PocketRequest{});
  balls.push_back({{0.0, 0.0, -20020.0}, 20000.0});
  const Pockets beside = pockets_of(balls, PocketRequest{});
  ASSERT_EQ(beside.pockets.size(), 1u);
  EXPECT_NEAR(beside.pockets[0].cavity.volume, alone.pockets[0].cavity.volume, 1e-6);
  EXPECT_EQ(beside.pockets[0].cavity.atoms, alone.pockets[0].cavity.atoms);
}

TEST(Pockets, AHoleIsAMouthAndTwoAreATunnel) {
  const Pockets cup = pockets_of(shell(5.5, 4.4), PocketRequest{});
  ASSERT_EQ(cup.pockets.size(), 1u);
  EXPECT_STREQ(cup.pockets[0].kind(), "pocket");
  // The rim's atoms are on a circle of 3.3 Å.
  EXPECT_GT(cup.pockets[0].mouth_area(), std::numbers::pi * 1.0 * 1.0);
  EXPECT_LT(cup.pockets[0].mouth_area(), std::numbers::pi * 4.0 * 4.0);
  // The probe reaches the far wall, 5.5 - 1.7 - 1.4 below the middle, and the large one does not come in.
  EXPECT_GT(cup.pockets[0].depth, 2.4);
  EXPECT_LT(cup.pockets[0].depth, 2 * 5.5);
  EXPECT_EQ(cup.pockets[0].cavity.atoms.size(), shell(5.5, 4.4).size());

  // A bowl's mouth is so wide that several large probes close it together.
  PocketRequest wide;
  wide.large_probe_radius = 12.0;
  const Pockets bowl = pockets_of(shell(9.0, 0.0), wide);
  ASSERT_EQ(bowl.pockets.size(), 1u);
  EXPECT_EQ(bowl.pockets[0].mouth_areas.size(), 1u);
  EXPECT_GT(std::ranges::count(bowl.pockets[0].atom, kNone), 1);

  const Pockets pipe = pockets_of(tube(5.0, 17), PocketRequest{});
  ASSERT_EQ(pipe.pockets.size(), 1u);
  const Pocket& tunnel = pipe.pockets[0];
  EXPECT_STREQ(tunnel.kind(), "tunnel");
  ASSERT_EQ(tunnel.mouth_areas.size(), 2u);
  EXPECT_NEAR(tunnel.mouth_areas[0], tunnel.mouth_areas[1], 0.02 * tunnel.mouth_areas[0]);
  // Some 4 Å of the cylinder inside of the atoms' surfaces, which is 20.8 Å long, are lost at the mouths.
  const double section = std::numbers::pi * 3.3 * 3.3;
  EXPECT_GT(tunnel.cavity.volume, 14.0 * section);
  EXPECT_LT(tunnel.cavity.volume, 21.0 * 1.1 * section);
  EXPECT_NEAR(tunnel.wall_area() + tunnel.mouth_area(), tunnel.cavity.area, 1e-9);
}

TEST(Pockets, ThereAreNoneWhereNothingIsHollow) {
  for (const Balls& balls : {Balls{{{1, 2, 3}, 1.7}}, two_atoms(3.0), ring(6, 1.4)}) {
    const Pockets found = pockets_of(balls, all_of_them());
    EXPECT_TRUE(found.pockets.empty());
    EXPECT_GE(found.between_volume, 0.0);
    EXPECT_FALSE(PocketLocator(found)({1, 2, 3}).has_value());
  }
}

struct Sampled {
  Pockets found;
  double clearance;
  SphereTracer small, large;
};

Sampled ubiquitin_with_oracles(double trim) {
  const Balls balls = ubiquitin();
  PocketRequest request = all_of_them();
  request.large_probe_radius = 5.0;
  request.trim = trim;
  const double r = request.probe_radius;
  return {pockets_of(balls, request), request.large_probe_radius + r + trim, SphereTracer(balls, r, 0.25),
          SphereTracer(balls, request.large_probe_radius, r + trim + 0.25)};
}

// Where the oracle of both probes says that a small probe's centre may be there must be a pocket, and whatever such a
// probe covers is in the same one. Probes at rest in pockets are where the oracle lets them be, up to the tolerance.
TEST(Pockets, AProteinsAgreeWithTheOraclePointByPoint) {
  for (const double trim : {0.0, 1.0}) {
    const auto [found, clearance, small, large] = ubiquitin_with_oracles(trim);
    const double r = found.request.probe_radius;
    ASSERT_GE(found.pockets.size(), 3u);
    const PocketLocator pocket_at(found);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::normal_distribution<double> normal;
    const auto step = [&] { return glm::dvec3(normal(random), normal(random), normal(random)); };
    int centers = 0;
    for (const Pocket& pocket : found.pockets)
      for (const glm::dvec3& probe : pocket.cavity.probes) {
        EXPECT_GT(large.nearest(probe).distance, clearance - found.request.tolerance - 2e-3);
        EXPECT_GT(small.outside(probe), -1e-9);
        for (int n = 0; n < 60; ++n) {
          const glm::dvec3 x = probe + 0.7 * step();
          if (small.outside(x) <= 0.0 || large.nearest(x).distance < clearance + 1e-9) continue;
          ++centers;
          const auto place = pocket_at(x);
          ASSERT_TRUE(place.has_value()) << x.x << " " << x.y << " " << x.z;
          EXPECT_EQ(pocket_at(x + (r - 1e-6) * std::cbrt(unit(random)) * glm::normalize(step())), place);
        }
      }
    EXPECT_GT(centers, 100);
  }
}

// The volume by random points, each of which is in the solid of the large probe, lowered by the trim, and not in that
// of the small one.
TEST(Pockets, AProteinsHaveTheVolumeThatSamplingFinds) {
  for (const double trim : {0.0, 1.0}) {
    const auto [found, clearance, small, large] = ubiquitin_with_oracles(trim);
    const double r = found.request.probe_radius;
    const PocketLocator pocket_at(found);
    glm::dvec3 low(1e9), high(-1e9);
    for (const Pocket& pocket : found.pockets)
      for (const glm::dvec3& probe : pocket.cavity.probes) {
        low = glm::min(low, probe - r);
        high = glm::max(high, probe + r);
      }
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    constexpr int kPoints = 10'000;
    int inside = 0;
    for (int n = 0; n < kPoints; ++n) {
      const glm::dvec3 x = low + glm::dvec3(unit(random), unit(random), unit(random)) * (high - low);
      if (!pocket_at(x)) continue;
      ++inside;
      EXPECT_LT(small.nearest(x).distance, r + 1e-9);
      EXPECT_GT(large.nearest(x).distance, clearance - r - found.request.tolerance - 2e-3);
    }
    const glm::dvec3 size = high - low;
    const double box = size.x * size.y * size.z, share = static_cast<double>(inside) / kPoints;
    EXPECT_NEAR(total_volume(found), box * share, 4 * box * std::sqrt(share * (1 - share) / kPoints));
    EXPECT_LT(total_volume(found), found.between_volume + total_excess(found));
  }
}

TEST(Pockets, GrowWithTheLargeProbeAndShrinkWithTrim) {
  const Balls balls = ubiquitin();
  double before = 0.0, hull = 0.0;
  for (const double large : {3.0, 4.0, 5.0}) {
    PocketRequest request = all_of_them();
    request.large_probe_radius = large;
    const Pockets found = pockets_of(balls, request);
    EXPECT_GT(total_volume(found), before - 1e-6) << large;
    EXPECT_GT(found.between_volume, hull) << large;
    before = total_volume(found) - total_excess(found);
    hull = found.between_volume;
  }
  double wider = 1e9;
  for (const double trim : {0.0, 1.0, 3.5}) {  // The last trim is larger than the atoms are thick.
    PocketRequest request = all_of_them();
    request.large_probe_radius = 5.0;
    request.trim = trim;
    const Pockets found = pockets_of(balls, request);
    EXPECT_LT(total_volume(found) - total_excess(found), wider + 1e-6) << trim;
    wider = total_volume(found);
  }
}

TEST(Pockets, DoNotDependOnOrientationMoreThanMouthsMay) {
  const Balls balls = ubiquitin();
  const Pockets found = pockets_of(balls, all_of_them());
  std::mt19937 random(3);
  for (int n = 0; n < 3; ++n) {
    const Pockets turned = pockets_of(rotated(balls, random_rotation(random)), all_of_them());
    EXPECT_NEAR(total_volume(turned), total_volume(found), total_excess(found));
    ASSERT_FALSE(turned.pockets.empty());
    EXPECT_EQ(turned.pockets[0].cavity.atoms, found.pockets[0].cavity.atoms);
    EXPECT_NEAR(turned.pockets[0].depth, found.pockets[0].depth, 0.1);
  }
}

TEST(Pockets, ATighterToleranceTakesNoMoreThanWasSaid) {
  const Balls balls = ubiquitin();
  PocketRequest request;
  request.tolerance = 0.3;
  const Pockets rough = pockets_of(balls, request);
  request.tolerance = 0.01;
  const Pockets fine = pockets_of(balls, request);
  EXPECT_GT(fine.probe_count, rough.probe_count);
  EXPECT_LT(total_volume(fine), total_volume(rough) + 1e-6 + total_excess(fine));
  EXPECT_GT(total_volume(fine), total_volume(rough) - total_excess(rough));
}

TEST(Pockets, AreTheSameForAnyNumberOfThreads) {
  const Balls balls = ubiquitin();
  const Pockets many = pockets_of(balls, all_of_them());
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Pockets alone = pockets_of(balls, all_of_them());
  ASSERT_EQ(many.pockets.size(), alone.pockets.size());
  EXPECT_EQ(many.probe_count, alone.probe_count);
  for (std::size_t n = 0; n < many.pockets.size(); ++n) {
    EXPECT_EQ(many.pockets[n].cavity.volume, alone.pockets[n].cavity.volume);
    EXPECT_EQ(many.pockets[n].mouth_areas, alone.pockets[n].mouth_areas);
    EXPECT_EQ(many.pockets[n].depth, alone.pockets[n].depth);
    EXPECT_EQ(many.pockets[n].cavity.atoms, alone.pockets[n].cavity.atoms);
  }
}

TEST(Pockets, MeshesAreClosedAndTurnedOutwards) {
  const Pockets found = pockets_of(ubiquitin(), PocketRequest{});
  ASSERT_GE(found.pockets.size(), 2u);
  const TriangleMesh solids = pocket_mesh(found, 0.02);
  for (std::uint32_t n = 0; n < found.pockets.size(); ++n) {
    const MeshMeasure measured = measure(solids, n);
    EXPECT_TRUE(measured.closed);
    EXPECT_NEAR(measured.volume, found.pockets[n].cavity.volume, 0.03 * found.pockets[n].cavity.volume);
    EXPECT_NEAR(measured.area, found.pockets[n].cavity.area, 0.03 * found.pockets[n].cavity.area);
  }
  for (std::size_t t = 0; t < solids.triangles.size(); ++t) {
    const auto& [a, b, c] = solids.triangles[t];
    const glm::dvec3 across =
        glm::cross(solids.positions[b] - solids.positions[a], solids.positions[c] - solids.positions[a]);
    if (glm::length(across) < 1e-4) continue;
    double along = glm::dot(glm::normalize(across), solids.normals[a]);
    for (std::size_t k = 0; k < solids.sharp_corners.size(); ++k)
      if (solids.sharp_corners[k] == 3 * t) along = glm::dot(glm::normalize(across), solids.sharp_corner_normals[k]);
    EXPECT_GT(along, 0.5) << t;
  }
  EXPECT_THROW(pocket_mesh(pockets_of(two_atoms(3.0), PocketRequest{}), 0.02), RequestError);
}

TEST(Pockets, WhatMakesNoSenseIsRefused) {
  const Balls balls = two_atoms(3.0);
  const auto fault = [&](double PocketRequest::*member, double value) {
    PocketRequest request;
    request.*member = value;
    EXPECT_THROW(pockets_of(balls, request), RequestError);
    return pocket_fault(request);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(pocket_fault(PocketRequest{}), "");
  EXPECT_NE(fault(&PocketRequest::probe_radius, 0.0).find("--probe"), std::string::npos);
  EXPECT_NE(fault(&PocketRequest::probe_radius, nan).find("--probe"), std::string::npos);
  EXPECT_NE(fault(&PocketRequest::large_probe_radius, 1.4).find("--large-probe"), std::string::npos);
  EXPECT_NE(fault(&PocketRequest::large_probe_radius, nan).find("--large-probe"), std::string::npos);
  EXPECT_NE(fault(&PocketRequest::trim, -0.1).find("--trim"), std::string::npos);
  EXPECT_NE(fault(&PocketRequest::trim, nan).find("--trim"), std::string::npos);
  EXPECT_NE(fault(&PocketRequest::tolerance, 0.0).find("--mouth-tolerance"), std::string::npos);

  // An open surface, of the molecule or of the molecule among large probes, is not a surface.
  const Balls cage = shell(5.5, 4.4);
  for (const std::size_t open : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    std::size_t computed = 0;
    EXPECT_THROW(find_pockets(cage, PocketRequest{},
                              [&](std::span<const Ball> atoms, double probe_radius) {
                                Surface surface = compute_surface_cpu(atoms, probe_radius);
                                if (computed++ == open) surface.certificate = {false, {0}, 0.0};
                                return surface;
                              }),
                 OpenSurfaceError)
        << open;
  }
}

}  // namespace
}  // namespace meniscus::testing
