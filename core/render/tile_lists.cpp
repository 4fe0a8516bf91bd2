// SPDX-License-Identifier: BSD-3-Clause
// Lists, on the GPU, the primitives that may show in each tile of a picture.
#include "core/render/tile_lists.h"

#include <string>
#include <vector>

namespace meniscus {

kernel::DepthSlices depth_slices(const GpuScene& scene) {
  const float thickness = (scene.last_depth - scene.first_depth) / static_cast<float>(kSliceCount);
  return {.first_depth = scene.first_depth, .slices_per_angstrom = thickness > 0.0f ? 1.0f / thickness : 0.0f};
}

std::uint32_t TileLists::slot_count() const {
  return static_cast<std::uint32_t>(tiles_.x) * static_cast<std::uint32_t>(tiles_.y) * kSlotsPerTile;
}

void TileLists::build(const GpuScene& scene, const PictureFrame& frame, const PictureBlock& block, Counting counting) {
  tiles_ = (block.size + (kTileEdge - 1)) / kTileEdge;
  counts_.resize((slot_count() + 1) * sizeof(std::uint32_t));
  counts_.fill(0);
  entries_.resize(0);
  primitive_texels_.view(scene.primitives.buffer);
  run(0, scene, frame, block);
  if (counting == Counting::later) {
    trusted_ = known_ + known_ / 8 + 64;
    scan_(counts_, slot_count(), trusted_);
  } else {
    scan_(counts_, slot_count());
    Readback readback;
    ask(readback);
    readback.read();
    trusted_ = known_ = counted_;
  }
  entries_.resize(trusted_ * sizeof(std::uint32_t));
  run(1, scene, frame, block);
  slot_texels_.view(counts_);
  entry_texels_.view(entries_);
  split_tiles();
}

void TileLists::ask(Readback& readback) { readback.ask(counts_, slot_count() * sizeof(std::uint32_t), {&counted_, 1}); }

bool TileLists::settle() {
  if (counted_ >= trusted_) return false;
  known_ = counted_;
  return true;
}

void TileLists::run(int pass, const GpuScene& scene, const PictureFrame& frame, const PictureBlock& block) {
  const Program& program = programs_.get("gpu_shaders/ray_cast/tile_lists.comp", {{"PASS", std::to_string(pass)}});
  primitive_texels_.bind(0);
  counts_.bind(0);
  entries_.bind(1);
  // Those of the picture's tiles say nothing of its map of shade, which has fewer.
  const glm::ivec2 all_tiles = tile_counts({{0, 0}, frame.size});
  const bool bounded =
      scene.tile_depths.byte_count() == sizeof(float) * static_cast<std::size_t>(all_tiles.x) * all_tiles.y;
  (bounded ? scene.tile_depths : counts_).bind(2);  // something must be there
  kernel::TileListParameters parameters = tile_list_parameters(frame, block, scene.primitives.most());
  parameters.bounded = bounded;
  parameters.entry_capacity = trusted_;
  scene.counters.bind(3);
  program.set(parameters);
  program.set(depth_slices(scene), kernel::kDepthSlicesBinding);
  program.dispatch(group_count(scene.primitives.most()));
}

void TileLists::split_tiles() {
  const auto tile_count = static_cast<std::uint32_t>(tiles_.x * tiles_.y);
  tile_order_.resize(tile_count * sizeof(std::uint32_t));
  dispatches_.upload(std::vector<std::uint32_t>{0, 1, 1, 0, 0, 1, 1, 0});
  slot_texels_.bind(0);
  tile_order_.bind(0);
  dispatches_.bind(1);
  const Program& program = programs_.get("gpu_shaders/ray_cast/split_tiles.comp");
  program.set(kernel::SplitTilesParameters{.tile_count = tile_count});
  program.dispatch(group_count(tile_count));
  order_texels_.view(tile_order_);
}

void TileLists::dispatch(const Program& ray_cast) const {
  primitive_texels_.bind(0);
  slot_texels_.bind(2);
  entry_texels_.bind(3);
  order_texels_.bind(4);
  ray_cast.dispatch_indirect(dispatches_);
}

void TileLists::clear_empty(const PictureBlock& block, const Buffer& picture, const Buffer& hits) const {
  order_texels_.bind(0);
  picture.bind(1);
  hits.bind(2);
  const Program& program = programs_.get("gpu_shaders/ray_cast/empty_tiles.comp");
  program.set(kernel::EmptyTilesParameters{.size = block.size, .tiles = tiles_});
  program.dispatch_indirect(dispatches_, 4 * sizeof(std::uint32_t));
}

}  // namespace meniscus
