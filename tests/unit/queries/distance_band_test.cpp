// SPDX-License-Identifier: BSD-3-Clause
// The band around the surface of one ball, whose distances are known.
#include "core/queries/distance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <tuple>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus {
namespace {

constexpr double kVoxel = 0.3;
constexpr int kReach = 2;
const glm::dvec3 kCenter(1.0, -2.0, 30.0);
constexpr double kRadius = 9.0;

DistanceBand band_of_a_ball() {
  return distance_band(compute_surface_cpu(testing::Balls{{kCenter, kRadius}}, 1.4), kVoxel, kReach);
}

TEST(DistanceBand, HasEachVoxelNearTheSurfaceWithItsDistance) {
  const DistanceBand band = band_of_a_ball();
  std::set<std::tuple<int, int, int>> in_band;
  for (const DistanceBand::Block& block : band.blocks)
    for (int n = 0; n < 512; ++n) {
      const glm::ivec3 at = block.origin + glm::ivec3(n / 64, n / 8 % 8, n % 8);
      const double exact = glm::length(kVoxel * glm::dvec3(at) - kCenter) - kRadius;
      ASSERT_NEAR(block.distances[n], std::clamp(exact, -kReach * kVoxel, kReach * kVoxel), 1e-6);
      if (std::abs(exact) < kReach * kVoxel) in_band.emplace(at.x, at.y, at.z);
    }
  std::size_t expected = 0;
  const glm::ivec3 middle(glm::round(kCenter / kVoxel));
  for (int x = -40; x <= 40; ++x)
    for (int y = -40; y <= 40; ++y)
      for (int z = -40; z <= 40; ++z) {
        const glm::dvec3 place = kVoxel * glm::dvec3(middle + glm::ivec3(x, y, z));
        expected += std::abs(glm::length(place - kCenter) - kRadius) < kReach * kVoxel ? 1 : 0;
      }
  EXPECT_EQ(in_band.size(), expected);
}

TEST(DistanceBand, FillsTheSolidWithCubesThatTheBandDoesNotReach) {
  const DistanceBand band = band_of_a_ball();
  double volume = 0.0;
  for (const auto& [origin, size] : band.inside) {
    volume += std::pow(kVoxel * size, 3);
    for (int n = 0; n < 8; ++n) {
      const glm::ivec3 corner = origin + (size - 1) * glm::ivec3(n & 1, n >> 1 & 1, n >> 2);
      EXPECT_LE(glm::length(kVoxel * glm::dvec3(corner) - kCenter) - kRadius, -kReach * kVoxel);
    }
  }
  for (const DistanceBand::Block& block : band.blocks)
    for (const float distance : block.distances) volume += distance < 0.0F ? std::pow(kVoxel, 3) : 0.0;
  EXPECT_NEAR(volume / (4.0 / 3.0 * M_PI * std::pow(kRadius, 3)), 1.0, 0.01);
}

TEST(DistanceBand, RefusesMoreVoxelsThanItHasRoomFor) {
  const Surface surface = compute_surface_cpu(testing::Balls{{kCenter, kRadius}}, 1.4);
  EXPECT_THROW(distance_band(surface, 1e-3, 3), CapacityError);
  EXPECT_THROW(distance_band(surface, 1e-12, 3), CapacityError);
}

}  // namespace
}  // namespace meniscus
