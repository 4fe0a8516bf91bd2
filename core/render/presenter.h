// SPDX-License-Identifier: BSD-3-Clause
// A finished picture as a texture for windows and encoders.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/gpu/buffer.h"
#include "core/gpu/program.h"

namespace meniscus {

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
