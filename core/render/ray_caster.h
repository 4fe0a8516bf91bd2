// SPDX-License-Identifier: BSD-3-Clause
// Pictures of the analytic surface: sphere, torus and clipped concave sphere, one ray a sample, never a mesh.
#pragma once

#include <memory>

#include "core/base/stage_clock.h"
#include "core/gpu/program.h"
#include "core/render/camera.h"
#include "core/render/framebuffer.h"
#include "core/render/ray_cast_scene.h"
#include "core/surface/coloring.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct RenderSettings {
  glm::ivec2 size{1024, 768};  ///< pixels
  int samples = 1;             ///< rays per pixel, the first through its centre
  bool aovs = false;           ///< fill the AOV arrays too
  int block_edge = 2048;       ///< larger pictures are cast in blocks of at most this edge, in pixels
};

/// Needs a current GL context for its whole life. The picture is the same for any block_edge.
class RayCaster {
 public:
  RayCaster();
  ~RayCaster();

  /// coloring.atom has one colour per surface.atoms. Rays go on through points of hidden atoms; what they meet from
  /// behind is shaded like its front, and its normal still points towards the solvent. Throws GpuError, CapacityError,
  /// InputError for a bad camera.
  Framebuffer render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                     const RenderSettings& settings);

  /// Times of the last render: packing and tile lists on the host, the kernel on the GPU.
  const std::vector<StageTime>& times() const { return clock_.times(); }

  /// A part of the picture, in pixels.
  struct Block {
    glm::ivec2 origin, size;
  };

 private:
  struct Buffers;

  RayCastScene upload_scene(const Surface& surface, const Coloring& coloring, const PictureFrame& frame);
  void set_uniforms(const Surface& surface, const Coloring& coloring, const PictureFrame& frame,
                    const RayCastScene& scene) const;
  void cast_block(const RayCastScene& scene, const PictureFrame& frame, const Block& block, int sample_count);

  Program program_;
  std::unique_ptr<Buffers> buffers_;
  StageClock clock_;
};

}  // namespace meniscus
