// SPDX-License-Identifier: BSD-3-Clause
// Post-processing on the GPU: shade, depth cueing and silhouettes, then a texture for windows and encoders.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/gpu/buffer.h"
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

}  // namespace meniscus
