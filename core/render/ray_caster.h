// SPDX-License-Identifier: BSD-3-Clause
// Pictures of the analytic surface: sphere, torus and clipped concave sphere, one ray a sample, never a mesh.
#pragma once

#include <functional>
#include <vector>

#include "core/base/stage_clock.h"
#include "core/gpu/program.h"
#include "core/gpu/buffer.h"
#include "core/render/gpu_scene.h"
#include "core/render/look.h"
#include "core/render/look_pass.h"
#include "core/render/ray_cast_scene.h"
#include "core/render/tile_lists.h"

namespace meniscus {

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
