// SPDX-License-Identifier: BSD-3-Clause
// Which primitives may show in which tile of a picture, found on the CPU.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "core/render/cpu/lane_kernels.h"
#include "core/render/picture_block.h"

namespace meniscus {

/// Tiles that a bound may touch: columns from x to before y, rows from z to before w.
class TileFootprints {
 public:
  TileFootprints(const PictureFrame& frame, const PictureBlock& block)
      : TileFootprints(tile_list_parameters(frame, block, 0)) {}
  explicit TileFootprints(const kernel::TileListParameters& params) : params_(params) {}

  /// bound: Primitive::bound.
  glm::ivec4 of(const glm::vec4& bound) const;

 private:
  kernel::TileListParameters params_;
};

/// For each tile the primitives whose bounds it may touch: the same lists as the GPU's (tile_lists.h), each in order.
class CpuTileLists {
 public:
  void build(std::span<const ray_cast::Primitive> primitives, const PictureFrame& frame, const PictureBlock& block);

  glm::ivec2 tiles() const { return tiles_; }  ///< columns, rows
  /// Places among the primitives, in any order; `tile` counts row by row.
  std::span<const std::uint32_t> entries(std::size_t tile) const {
    return std::span(entries_).subspan(starts_[tile], starts_[tile + 1] - starts_[tile]);
  }

 private:
  glm::ivec2 tiles_{0};
  std::vector<std::uint32_t> starts_;  // one more than tiles
  std::vector<std::uint32_t> entries_;
};

/// A tile's list as the inner loops read it. Keeps its arrays from tile to tile.
class SortedList {
 public:
  /// Valid until the next one is sorted.
  LaneList sort(std::span<const std::uint32_t> entries, std::span<const ray_cast::Primitive> primitives);

 private:
  std::vector<std::uint64_t> keys_;
  std::vector<float> numbers_[5];
  std::vector<std::uint32_t> primitives_;
};

}  // namespace meniscus
