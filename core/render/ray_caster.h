// SPDX-License-Identifier: BSD-3-Clause
// Casts blocks of a picture on the GPU, one ray per sample, and finishes their samples: shade, depth cue, outlines.
#pragma once

#include "core/base/progress.h"
#include "core/gpu/buffer.h"
#include "core/gpu/kernel_lists.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/program.h"
#include "core/render/gpu_pack.h"
#include "core/render/light_maps.h"
#include "core/render/look.h"
#include "core/render/picture_block.h"
#include "core/render/ray_cast_pack.h"

namespace meniscus {

/// One sample of each pixel of a block, as the ray caster returns it.
struct CastSample {
  const Buffer& colors;  ///< vec4 each
  const Buffer& hits;    ///< ray_cast::Hit each
  int index;
  glm::vec2 offset;  ///< offset from the centres of pixels, in pixels
};

/// Runs the kernels of gpu_shaders/look/ and owns their buffers. Needs a current GL context. The programs must outlive
/// it.
class LookPass {
 public:
  explicit LookPass(ProgramCache& programs) : programs_(programs) {}

  /// Adds the sample's colours, changed by the look's effects, to `picture`; the first sample replaces its content.
  void add(const CastSample& sample, const Look& look, const GpuPack& scene, const PictureFrame& frame,
           const PictureBlock& block, const Buffer& picture);

  /// Makes the maps for the shade of a picture of these atoms. basis: axes of the camera.
  void make_light_maps(std::span<const Ball> atoms, const GpuPack& scene, const Look& look, const ViewBasis& basis);

 private:
  ProgramCache& programs_;
  LightMaps light_maps_;
  Buffer depths_, light_map_, marks_, shade_;
  TexelBuffer first_hit_texels_{TexelFormat::uint4}, hit_texels_{TexelFormat::uint4};  // sample 0; other samples
  TexelBuffer depth_texels_{TexelFormat::uint1}, light_texels_{TexelFormat::uint1}, shade_texels_{TexelFormat::uint4},
      mark_texels_{TexelFormat::uint1}, atom_mark_texels_{TexelFormat::uint1};
};

/// Owns the texture of the last picture presented. Needs a current GL context for its whole life.
class Presenter {
 public:
  Presenter() = default;
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  /// Presents a picture. picture: sums of `sample_count` samples, as RayCaster::picture(); background: sRGB. The
  /// pixels are shown without further checks, so the GPU's work must be verified before this call. Throws GpuError.
  void present(const Buffer& picture, glm::ivec2 size, int sample_count, const glm::vec3& background);

  /// Returns the pixels: 8 bit sRGB and alpha (255), rows from the top. Waits for the GPU.
  std::vector<std::uint8_t> rgba() const;

 private:
  Program program_{"gpu_shaders/look/present.comp"};
  std::uint32_t texture_ = 0;
  glm::ivec2 size_{0};
};

inline constexpr std::uint32_t kSliceCount = 32;
inline constexpr std::uint32_t kSlotsPerTile = 2 * kSliceCount;

/// Two lists of primitives, spheres and tori, for each tile of 16 x 16 pixels. Each list is divided into slices of
/// depth, nearest slice first, in any order within a slice. A list covers all rays through any place in its tile's
/// pixels. Needs a current GL context. The programs must outlive it.
class TileLists {
 public:
  explicit TileLists(ProgramCache& programs) : programs_(programs), scan_(programs) {}

  /// Builds the lists. Throws CapacityError if they are larger than a kernel can address; smaller blocks help. With
  /// Counting::later they get the memory that they needed last time and some more.
  void build(const GpuPack& scene, const PictureFrame& frame, const PictureBlock& block,
             Counting counting = Counting::now);
  /// For Counting::later, request_counts() queues the reading of the counts that the host needs. Once they have been
  /// read, take_counts() returns whether the memory was sufficient.
  void request_counts(Readback& readback);
  bool take_counts();

  glm::ivec2 tiles() const { return tiles_; }  ///< columns, rows
  /// Returns one uint32 for each slice of spheres and of tori of each tile, row by row: the end of its primitives in
  /// entries(). They begin at the end of the slice before.
  const Buffer& slot_ends() const { return counts_; }
  const Buffer& entries() const { return entries_; }  ///< uint32 each: places in GpuPack::primitives

  /// Binds the buffers that gpu_shaders/ray_cast/ray_cast.comp reads and dispatches it, one group for each tile with a
  /// list that is not empty.
  void dispatch(const Program& ray_cast) const;
  /// Writes the values of a miss to all other tiles of both buffers, in the same format as RayCaster.
  void clear_empty(const PictureBlock& block, const Buffer& picture, const Buffer& hits) const;

 private:
  void split_tiles();
  void run(int pass, const GpuPack& scene, const PictureFrame& frame, const PictureBlock& block);
  std::uint32_t slot_count() const;

  ProgramCache& programs_;
  PrefixSum scan_;
  glm::ivec2 tiles_{0};
  Buffer counts_, entries_;
  std::uint32_t counted_ = 0, known_ = 0, trusted_ = 0;  // sizes of entries: read back, last counted, allocated
  Buffer tile_order_, dispatches_;                       // buffers of split_tiles.comp
  TexelBuffer primitive_texels_{TexelFormat::uint4}, slot_texels_{TexelFormat::uint1},
      entry_texels_{TexelFormat::uint1}, order_texels_{TexelFormat::uint1};
};

/// Returns the borders of the scene's slices of depth.
kernel::DepthSlices depth_slices(const GpuPack& scene);

/// Settings for casting a block.
struct CastSettings {
  int samples = 1;  ///< rays per pixel, the first through its centre
  Look look{};      ///< its background is ignored; effects do not see anything outside of the block
  Counting counting = Counting::now;
  std::function<bool()> stop{};  ///< called between samples; if it returns true, casting stops
  StageClock* clock = nullptr;   ///< receives the time of each stage
};

/// Casts blocks of pictures. Needs a current GL context for its whole life.
class RayCaster {
 public:
  /// Casts a block of a picture and leaves the result on the GPU, in picture() and hits(). frame.size is the size of
  /// the whole picture. Returns false, and leaves no picture, if casting was stopped. Throws CapacityError if the block
  /// is too large for this GPU, and GpuError if the GPU fails.
  bool cast(const GpuPack& scene, const PictureFrame& frame, const PictureBlock& block,
            const CastSettings& settings = {});

  /// Makes the maps that a look with shade needs, before the blocks of a picture are cast.
  void make_light_maps(std::span<const Ball> atoms, const GpuPack& scene, const Look& look, const ViewBasis& basis) {
    look_pass_.make_light_maps(atoms, scene, look, basis);
  }

  /// True if the next block may be cast with Counting::later: the last block had the same size, and the loops of its
  /// kernels ran to completion. Such a block is valid only if take_counts() returns true after the counts that
  /// request_counts() queued have been read.
  bool can_trust(const PictureBlock& block) const { return known_size_ == block.size; }
  void request_counts(Readback& readback);
  bool take_counts();

  /// Returns the pixels of the last block, row by row from the top: one vec4 per pixel, the sum of its samples, linear
  /// and premultiplied.
  const Buffer& picture() const { return picture_; }
  /// Returns the ray_cast::Hit of the ray through the centre of each pixel in the same order.
  const Buffer& hits() const { return hits_; }

 private:
  struct Parameters;

  void cast_sample(const GpuPack& scene, const CastSample& sample, const Parameters& parameters, Counting counting);
  void start(const Program& program, const GpuPack& scene, const CastSample& sample, const Parameters& parameters);
  void finish_long_lists(std::uint32_t longest, const GpuPack& scene, const CastSample& sample, Parameters parameters);
  const Program& program(const GpuPack& scene, bool resumed);

  ProgramCache programs_;
  TileLists lists_{programs_};
  TexelBuffer row_texels_{TexelFormat::uint4};
  LookPass look_pass_{programs_};
  Buffer picture_, hits_;
  glm::ivec2 known_size_{0};            // size of the last block if its counts are valid
  glm::ivec2 size_{0};                  // size of the current block
  std::uint32_t longest_ = 0;           // longest list of an unfinished invocation
  bool long_lists_ = false;             // some sample had unfinished invocations
  Buffer unfinished_, states_;          // invocations whose loops the driver cut short
  Buffer sample_colors_, sample_hits_;  // buffers for looks with effects
};

}  // namespace meniscus
