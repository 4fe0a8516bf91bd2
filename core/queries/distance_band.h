// SPDX-License-Identifier: BSD-3-Clause
// The signed distance from the surface on a lattice of voxels, in a narrow band around it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

struct Surface;

/// The lattice is that of whole multiples of the voxel's edge: voxel (i, j, k) stands for the point i, j, k times it.
struct DistanceBand {
  static constexpr int kEdge = 8;  ///< voxels along a block
  /// A block that the band reaches.
  struct Block {
    glm::ivec3 origin{0};  ///< its first voxel; multiples of kEdge
    /// Å, above 0 in the solvent, no further from 0 than the band reaches; z runs fastest.
    std::array<float, kEdge * kEdge * kEdge> distances{};
  };
  /// A cube of voxels that are all deeper in the solid.
  struct Inside {
    glm::ivec3 origin{0};  ///< multiples of its size
    int size = 0;          ///< voxels along its edge: kEdge times a power of two
  };
  double voxel = 0.0;  ///< Å
  float reach = 0.0F;  ///< Å
  std::vector<Block> blocks;
  std::vector<Inside> inside;
};

inline constexpr std::size_t kMostBandBlocks = std::size_t{1} << 21;  // 4 GiB

/// surface: closed. voxel: Å; reach: of the band, in voxels, at least 1. Each distance is exact but for rounding to a
/// float. Blocks and cubes are in the same order each time. Throws CapacityError for more than kMostBandBlocks.
DistanceBand distance_band(const Surface& surface, double voxel, int reach);

}  // namespace meniscus
