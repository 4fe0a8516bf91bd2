// SPDX-License-Identifier: BSD-3-Clause
// Puts a finished picture into a window.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

namespace meniscus {

/// Needs the window's context current for its whole life.
class PictureView {
 public:
  PictureView();
  ~PictureView();
  PictureView(const PictureView&) = delete;
  PictureView& operator=(const PictureView&) = delete;

  /// Puts a texture of `size` (GL_RGBA8, sRGB values, first row on top) into the upper left `area` (pixels) of a window
  /// `window` pixels large. Of equal sizes every pixel is the picture's own; else it is stretched until it fits.
  void show(std::uint32_t texture, glm::ivec2 size, glm::ivec2 area, glm::ivec2 window);

 private:
  std::uint32_t framebuffer_ = 0;
};

}  // namespace meniscus
