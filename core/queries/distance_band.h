// SPDX-License-Identifier: BSD-3-Clause
// Computes the signed distance from a surface on a lattice of voxels, in a narrow band around the surface.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

struct Surface;

/// A narrow band of distances on a lattice: voxel (i, j, k) represents the point (i, j, k) times the voxel's edge.
struct DistanceBand {
  static constexpr int kEdge = 8;  ///< voxels along the edge of a block
  /// A block that the band reaches.
  struct Block {
    glm::ivec3 origin{0};  ///< first voxel of the block; multiples of kEdge
    /// Distances in Å, above 0 in the solvent, clamped to the reach of the band; z runs fastest.
    std::array<float, kEdge * kEdge * kEdge> distances{};
  };
  /// A cube of voxels that are all deeper in the solid than the band.
  struct Inside {
    glm::ivec3 origin{0};  ///< first voxel of the cube; multiples of its size
    int size = 0;          ///< voxels along the edge of the cube: kEdge times a power of two
  };
  double voxel = 0.0;  ///< Å, the edge of a voxel
  float reach = 0.0F;  ///< Å, how far the band extends on either side of the surface
  std::vector<Block> blocks;
  std::vector<Inside> inside;
};

inline constexpr std::size_t kMostBandBlocks = std::size_t{1} << 21;  // 4 GiB

/// Computes the band of a closed surface. `voxel` is the edge of a voxel in Å, `reach` the half width of the band in
/// voxels, at least 1. Each distance is exact but for rounding to a float. Blocks and cubes are in the same order each
/// time. Throws CapacityError for more than kMostBandBlocks blocks.
DistanceBand distance_band(const Surface& surface, double voxel, int reach);

}  // namespace meniscus
