// SPDX-License-Identifier: BSD-3-Clause
// Finds the blocks of voxels near the surface by halving cubes: along a step a distance changes by no more than the
// step's length, so the middle of a cube tells whether the band reaches the cube.
#include "core/queries/distance_band.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/base/message.h"
#include "core/math/box.h"
#include "core/queries/distance.h"
#include "core/surface/primitives.h"

namespace meniscus {
namespace {

constexpr int kEdge = DistanceBand::kEdge;
constexpr double kMostVoxels = 1 << 28;  // from the origin along an axis

/// Finds the blocks and cubes of a band.
class BandFinder {
 public:
  BandFinder(const Surface& surface, double voxel, double reach) : distance_(surface), voxel_(voxel), reach_(reach) {
    for (const Ball& ball : surface.atoms) {
      box_.include(ball.center - ball.radius - reach);
      box_.include(ball.center + ball.radius + reach);
    }
  }

  DistanceBand find() const {
    DistanceBand band{voxel_, static_cast<float>(reach_), {}, {}};
    int size = largest_cube();
    std::vector<glm::ivec3> cubes;
    cubes.reserve(8);
    for (int n = 0; n < 8; ++n) cubes.push_back(size * (corner(n) - 1));
    for (;; size /= 2) {
      std::vector<glm::ivec3> near = near_cubes(cubes, size, band.inside);
      check_count(near.size(), size);
      if (size == kEdge) {
        cubes = std::move(near);
        break;
      }
      cubes.clear();
      for (const glm::ivec3& origin : near)
        for (int n = 0; n < 8; ++n) cubes.push_back(origin + size / 2 * corner(n));
    }
    band.blocks.resize(cubes.size());
    tbb::parallel_for(std::size_t{0}, cubes.size(), [&](std::size_t n) { band.blocks[n] = block_at(cubes[n]); });
    return band;
  }

 private:
  enum class Place : std::uint8_t { near, outside, inside };

  static glm::ivec3 corner(int n) { return {n & 1, n >> 1 & 1, n >> 2}; }

  [[noreturn]] void refuse() const {
    throw CapacityError(message("voxels of {:g} Å make more than {} million of them; choose a larger @voxel@", voxel_,
                                kMostBandBlocks * kEdge * kEdge * kEdge / 1'000'000));
  }

  /// Returns the edge, in voxels, of the largest cubes: eight of them around the origin hold all of the band.
  int largest_cube() const {
    const glm::dvec3 far = glm::max(glm::abs(box_.low), glm::abs(box_.high)) / voxel_;
    const double half = std::max({far.x, far.y, far.z});
    if (half > kMostVoxels) refuse();
    return std::max(kEdge, static_cast<int>(std::bit_ceil(static_cast<unsigned>(half) + 2U)));
  }

  /// Throws CapacityError if there will be too many blocks. Halving cubes makes at least four times as many along a
  /// surface, so this is known before they exist.
  void check_count(std::size_t count, int size) const {
    const glm::dvec3 extent = box_.high - box_.low;
    if (size > kEdge && 4.0 * size * voxel_ > std::max({extent.x, extent.y, extent.z})) return;
    const double halvings = static_cast<double>(size) / kEdge;
    if (static_cast<double>(count) * halvings * halvings > (size > kEdge ? 2.0 : 1.0) * kMostBandBlocks) refuse();
  }

  /// Returns the place of a cube with respect to the band, as the distance of its middle tells it.
  Place place_of(const glm::ivec3& origin, int size) const {
    const glm::dvec3 middle = voxel_ * (glm::dvec3(origin) + 0.5 * (size - 1));
    const double to_corner = 0.5 * (size - 1) * voxel_ * std::numbers::sqrt3;
    if (box_.squared_distance(middle) > to_corner * to_corner) return Place::outside;
    const double distance = distance_(middle).distance;
    if (std::abs(distance) < reach_ + to_corner) return Place::near;
    return distance < 0.0 ? Place::inside : Place::outside;
  }

  /// Returns the cubes that the band may reach, and adds those in the solid to `inside`.
  std::vector<glm::ivec3> near_cubes(const std::vector<glm::ivec3>& cubes, int size,
                                     std::vector<DistanceBand::Inside>& inside) const {
    std::vector<Place> places(cubes.size());
    tbb::parallel_for(std::size_t{0}, cubes.size(), [&](std::size_t n) { places[n] = place_of(cubes[n], size); });
    std::vector<glm::ivec3> near;
    for (std::size_t n = 0; n < cubes.size(); ++n) {
      if (places[n] == Place::near) near.push_back(cubes[n]);
      if (places[n] == Place::inside) inside.push_back({cubes[n], size});
    }
    return near;
  }

  DistanceBand::Block block_at(const glm::ivec3& origin) const {
    DistanceBand::Block block{origin, {}};
    const auto limit = static_cast<float>(reach_);
    for (int n = 0; n < kEdge * kEdge * kEdge; ++n) {
      const glm::dvec3 place(origin + glm::ivec3(n / (kEdge * kEdge), n / kEdge % kEdge, n % kEdge));
      block.distances[n] = std::clamp(static_cast<float>(distance_(voxel_ * place).distance), -limit, limit);
    }
    return block;
  }

  SurfaceDistance distance_;
  double voxel_, reach_;
  Box box_;
};

}  // namespace

DistanceBand distance_band(const Surface& surface, double voxel, int reach) {
  return BandFinder(surface, voxel, reach * voxel).find();
}

}  // namespace meniscus
