// SPDX-License-Identifier: BSD-3-Clause
// Which primitives may show in which tile of a picture, found on the GPU.
#pragma once

#include <glm/vec2.hpp>

#include "core/gpu/buffer.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/kernel_lists.h"
#include "core/gpu/program.h"
#include "core/render/gpu_scene.h"
#include "core/render/picture_block.h"
#include "core/render/ray_cast_scene.h"

namespace meniscus {

inline constexpr std::uint32_t kSliceCount = 32;
inline constexpr std::uint32_t kSlotsPerTile = 2 * kSliceCount;

/// For each tile of 16 x 16 pixels two lists of primitives, spheres and tori, each by slices of depth, nearest slice
/// first, in any order within a slice. A list covers all rays through any place of its tile's pixels. Needs a current
/// GL context.
class TileLists {
 public:
  explicit TileLists(ProgramCache& programs) : programs_(programs), scan_(programs) {}

  /// Throws CapacityError when the lists are larger than a kernel can see; smaller blocks help. With Counting::later
  /// they get the room that they needed last time and some more.
  void build(const GpuScene& scene, const PictureFrame& frame, const PictureBlock& block,
             Counting counting = Counting::now);
  /// For Counting::later: what the host has to know, and, once that has been read back, whether there was room.
  void ask(Readback& readback);
  bool settle();

  glm::ivec2 tiles() const { return tiles_; }  ///< columns, rows
  /// uint32 for each slice of spheres and of tori of each tile, row by row: where its primitives end in entries(); they
  /// begin where the slice before ends.
  const Buffer& slot_ends() const { return counts_; }
  const Buffer& entries() const { return entries_; }  ///< uint32 each: places in GpuScene::primitives

  /// Binds what gpu_shaders/ray_cast/ray_cast.comp fetches and starts it, a group for each tile that lists something.
  void dispatch(const Program& ray_cast) const;
  /// Writes what rays see in the other tiles. Both buffers as RayCaster leaves them.
  void clear_empty(const PictureBlock& block, const Buffer& picture, const Buffer& hits) const;

 private:
  void split_tiles();
  void run(int pass, const GpuScene& scene, const PictureFrame& frame, const PictureBlock& block);
  std::uint32_t slot_count() const;

  ProgramCache& programs_;
  PrefixSum scan_;
  glm::ivec2 tiles_{0};
  Buffer counts_, entries_;
  std::uint32_t counted_ = 0, known_ = 0, trusted_ = 0;  // entries: read back, as last counted, with room
  Buffer tile_order_, dispatches_;                       // of split_tiles.comp
  TexelBuffer primitive_texels_{TexelFormat::uint4}, slot_texels_{TexelFormat::uint1},
      entry_texels_{TexelFormat::uint1}, order_texels_{TexelFormat::uint1};
};

/// Where the scene's depths are cut into slices.
kernel::DepthSlices depth_slices(const GpuScene& scene);

}  // namespace meniscus
