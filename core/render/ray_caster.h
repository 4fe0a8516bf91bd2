// SPDX-License-Identifier: BSD-3-Clause
// Pictures of the analytic surface: sphere, torus and clipped concave sphere, one ray a sample, never a mesh.
#pragma once

#include <functional>

#include "core/base/stage_clock.h"
#include "core/gpu/program.h"
#include "core/gpu/texel_buffer.h"
#include "core/camera/camera.h"
#include "core/render/framebuffer.h"
#include "core/render/gpu_scene.h"
#include "core/render/look.h"
#include "core/render/look_pass.h"
#include "core/render/ray_cast_scene.h"
#include "core/render/tile_lists.h"
#include "core/color/coloring.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct RenderSettings {
  glm::ivec2 size{1024, 768};  ///< pixels
  int samples = 1;             ///< rays per pixel, the first through its centre
  bool aovs = false;           ///< fill the AOV arrays too
  int block_edge = 2048;       ///< larger pictures are cast in blocks of at most this edge, in pixels
  Look look;                   ///< but for its background
};

/// Needs a current GL context for its whole life. The picture is the same for any block_edge.
class RayCaster {
 public:
  /// coloring.atom has one colour per surface.atoms. Rays go on through points of hidden atoms; what they meet from
  /// behind is shaded like its front, and its normal still points towards the solvent. Throws GpuError, CapacityError,
  /// InputError for a bad camera.
  Framebuffer render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                     const RenderSettings& settings);

  /// The same for a scene that is on the GPU already; settings.size is frame.size, and there are no AOVs.
  Framebuffer render(const GpuScene& scene, const PictureFrame& frame, const RenderSettings& settings);

  /// Casts a block of a picture of a scene that is on the GPU already and leaves it there, in picture() and hits().
  /// frame.size is that of the whole picture. The look's effects see nothing of what lies outside the block, and its
  /// background is not used. stop: asked between samples; if true, the block is given up: false, and no picture. Throws
  /// GpuError; CapacityError if the block is too large for this GPU.
  bool cast(const GpuScene& scene, const PictureFrame& frame, const PictureBlock& block, int sample_count,
            const Look& look, const std::function<bool()>& stop = {});
  /// Casts the whole picture.
  bool cast(const GpuScene& scene, const PictureFrame& frame, int sample_count, const Look& look = {},
            const std::function<bool()>& stop = {}) {
    return cast(scene, frame, {{0, 0}, frame.size}, sample_count, look, stop);
  }

  /// Of the last block, row by row from the top: vec4 per pixel, the sum of its samples, linear and premultiplied.
  const Buffer& picture() const { return picture_; }
  /// Likewise ray_cast::Hit, of the ray through the pixel's centre.
  const Buffer& hits() const { return hits_; }

  /// Times of what was cast since the last render began, or since restart_times().
  const std::vector<StageTime>& times() const { return clock_.times(); }
  void restart_times() { clock_.restart(); }

 private:
  struct Collected;
  struct Parameters;

  void render_blocks(Collected& collected);
  void render_block(const PictureBlock& inner, Collected& collected);
  void cast_sample(const GpuScene& scene, const CastSample& sample, const Parameters& parameters);
  void start(const Program& program, const GpuScene& scene, const CastSample& sample, const Parameters& parameters);
  void finish_long_lists(std::uint32_t longest, const GpuScene& scene, const CastSample& sample, Parameters parameters);
  const Program& program(const GpuScene& scene, bool resumed);

  ProgramCache programs_;
  TileLists lists_{programs_};
  GpuScene scene_;  // of render
  TexelBuffer row_texels_{TexelFormat::uint4};
  LookPass look_pass_{programs_};
  Buffer picture_, hits_;
  Buffer unfinished_, states_;          // of invocations whose loops the driver cut short
  Buffer sample_colors_, sample_hits_;  // where a look has effects
  StageClock clock_;
};

}  // namespace meniscus
