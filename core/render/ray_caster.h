// SPDX-License-Identifier: BSD-3-Clause
// Casts blocks of a picture on the GPU, one ray per sample, and finishes their samples: shade, depth cue, outlines.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/progress.h"
#include "core/gpu/buffer.h"
#include "core/gpu/kernel_lists.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/program.h"
#include "core/render/gpu_scene.h"
#include "core/render/look.h"
#include "core/render/picture_block.h"
#include "core/render/ray_cast_scene.h"

namespace meniscus {

/// One sample of each pixel of a block, as the ray caster leaves it.
struct CastSample {
  const Buffer& colors;  ///< vec4 each
  const Buffer& hits;    ///< ray_cast::Hit each
  int index;
  glm::vec2 offset;  ///< from the pixels' centres, pixels
};

/// Kernels of gpu_shaders/look/ and their buffers. Needs a current GL context.
class LookPass {
 public:
  explicit LookPass(ProgramCache& programs) : programs_(programs) {}

  /// Adds the sample's colours, changed by the look's effects, to `picture`; the first sample replaces it.
  void add(const CastSample& sample, const Look& look, const GpuScene& scene, const PictureFrame& frame,
           const PictureBlock& block, const Buffer& picture);

  /// Along the view axis, of the first sample's hits of a block; kernel::kNothing where nothing is met.
  std::vector<float> depths(const Buffer& hits, const PictureFrame& frame, const PictureBlock& block);

  /// Those of all pixels of shade_map_frame(): for pictures whose blocks do not hold the map.
  void set_shade_map(const std::vector<float>& depths);

 private:
  ProgramCache& programs_;
  Buffer depths_, shade_map_, marks_, shade_;
  TexelBuffer first_hit_texels_{TexelFormat::uint4}, hit_texels_{TexelFormat::uint4};  // of sample 0, of the others
  TexelBuffer depth_texels_{TexelFormat::uint1}, map_texels_{TexelFormat::uint1}, shade_texels_{TexelFormat::uint1},
      mark_texels_{TexelFormat::uint1}, atom_mark_texels_{TexelFormat::uint1};
};

/// Owns the texture of the last picture presented. Needs a current GL context for its whole life.
class Presenter {
 public:
  Presenter() = default;
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  /// picture: sums of `sample_count` samples, as RayCaster::picture(); background: sRGB. Others show the texture
  /// without another look at it: the GPU's work has to be proven before they may. Throws GpuError.
  void present(const Buffer& picture, glm::ivec2 size, int sample_count, const glm::vec3& background);

  /// GL_RGBA8, sRGB values, alpha 255, first row on top; lives until a picture of another size is presented.
  std::uint32_t texture() const { return texture_; }
  /// The same on the host; waits for the GPU.
  std::vector<std::uint8_t> rgba() const;

 private:
  Program program_{"gpu_shaders/look/present.comp"};
  std::uint32_t texture_ = 0;
  glm::ivec2 size_{0};
};

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

/// How a block is cast.
struct CastSettings {
  int samples = 1;  ///< rays per pixel, the first through its centre
  Look look{};      ///< but for its background; effects see nothing of what lies outside the block
  Counting counting = Counting::now;
  std::function<bool()> stop{};  ///< asked between samples; if true, the block is given up
  StageClock* clock = nullptr;   ///< gets the time of each stage
};

/// Needs a current GL context for its whole life.
class RayCaster {
 public:
  /// Casts a block of a picture and leaves it on the GPU, in picture() and hits(). frame.size is that of the whole
  /// picture. False if it was given up: then there is no picture. Throws GpuError; CapacityError if the block is too
  /// large for this GPU.
  bool cast(const GpuScene& scene, const PictureFrame& frame, const PictureBlock& block,
            const CastSettings& settings = {});

  /// The depths of a block of shade_map_frame(), row by row; picture() and hits() are then those of the map. Throws as
  /// cast().
  std::vector<float> cast_depths(const GpuScene& scene, const PictureFrame& map, const PictureBlock& block) {
    cast(scene, map, block);
    return look_pass_.depths(hits_, map, block);
  }
  /// For the shade of blocks that do not hold it: depths of the whole map.
  void set_shade_map(const std::vector<float>& depths) { look_pass_.set_shade_map(depths); }

  /// Whether the next block, of so many pixels, may be cast with Counting::later: the last one was no other, and its
  /// kernels' loops went to their ends. Such a block is good only if settle() says so, once what ask() asks for has
  /// been read back.
  bool can_trust(const PictureBlock& block) const { return known_size_ == block.size; }
  void ask(Readback& readback);
  bool settle();

  /// Of the last block, row by row from the top: vec4 per pixel, the sum of its samples, linear and premultiplied.
  const Buffer& picture() const { return picture_; }
  /// Likewise ray_cast::Hit, of the ray through the pixel's centre.
  const Buffer& hits() const { return hits_; }

 private:
  struct Parameters;

  void cast_sample(const GpuScene& scene, const CastSample& sample, const Parameters& parameters, Counting counting);
  void start(const Program& program, const GpuScene& scene, const CastSample& sample, const Parameters& parameters);
  void finish_long_lists(std::uint32_t longest, const GpuScene& scene, const CastSample& sample, Parameters parameters);
  const Program& program(const GpuScene& scene, bool resumed);

  ProgramCache programs_;
  TileLists lists_{programs_};
  TexelBuffer row_texels_{TexelFormat::uint4};
  LookPass look_pass_{programs_};
  Buffer picture_, hits_;
  glm::ivec2 known_size_{0};            // of the last block, if nothing went wrong
  glm::ivec2 size_{0};                  // of the block at work
  std::uint32_t longest_ = 0;           // list of an unfinished invocation
  bool long_lists_ = false;             // some sample had one
  Buffer unfinished_, states_;          // of invocations whose loops the driver cut short
  Buffer sample_colors_, sample_hits_;  // where a look has effects
};

}  // namespace meniscus
