// SPDX-License-Identifier: BSD-3-Clause
// The exact signed distance from a surface: at any point, and on a lattice of voxels in a band around the surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

struct Surface;

/// The point of a surface that is nearest to a given point.
struct NearestPoint {
  double distance = 0.0;  ///< Å, Euclidean: above 0 in the solvent, below 0 in the solid
  glm::dvec3 point{0.0};  ///< Å, on the surface; one of them if several are equally near
};

/// Computes distances from points to one surface; any number of threads may call it. Results are exact but for
/// rounding, at any distance:
///  * A point of the solid is as far from the surface as from the accessible region A, less the probe's radius, because
///    along the line to the nearest place of the probe the distance from A falls as fast as the point moves. That place
///    lies on a SAS sphere or on an arc, or is a fixed probe.
///  * From the solvent the nearest point is a foot inside of a patch, where the line to it is normal to a sphere or a
///    torus; or a foot on a border; or a vertex. All of them are tried, those in nearer boxes first.
class SurfaceDistance {
 public:
  /// `surface` is closed and has at least one atom. It must outlive this object and not change.
  explicit SurfaceDistance(const Surface& surface);
  ~SurfaceDistance();
  SurfaceDistance(SurfaceDistance&&) noexcept;
  SurfaceDistance& operator=(SurfaceDistance&&) noexcept;

  /// The largest coordinate (Å) that a point may have, so that squares of distances are finite.
  static constexpr double kFarthest = 1e150;

  /// Returns the distance (Å) of a point from the surface, and the surface's point that is nearest.
  NearestPoint operator()(const glm::dvec3& point) const;

  /// True if the point is no farther than `limit` (Å, above 0) from the surface, on either side. Faster than computing
  /// the distance.
  bool is_within(const glm::dvec3& point, double limit) const;

  /// Returns the distance (Å) from the point to the nearest place of a probe that touches an atom, on whichever side of
  /// the SAS the point is. The places are given by the patches of the surface, or of a part of it alone (SurfacePart).
  double to_probe(const glm::dvec3& point) const;

  /// True if a probe at the point would overlap an atom; for a part of a surface, an atom of that part.
  bool in_sas(const glm::dvec3& point) const;

 private:
  struct Index;
  std::unique_ptr<const Index> index_;
};

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
