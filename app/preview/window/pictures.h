// SPDX-License-Identifier: BSD-3-Clause
// Passes pictures from the drawing thread to the window, without a copy through the CPU where the GPU draws
// them.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <span>

#include <glm/vec2.hpp>

namespace meniscus {

/// A texture, GL_RGBA8, first row on top; 0: none.
struct SharedPicture {
  std::uint32_t texture = 0;
  glm::ivec2 size{0};
};

/// Three textures: one is shown, one is ready, one may be written. Their contexts share textures.
class PictureExchange {
 public:
  /// With a context current.
  ~PictureExchange();

  /// On the drawing thread: copies a texture and offers the copy in place of the last one offered.
  void offer(std::uint32_t texture, glm::ivec2 size);
  /// The same with a picture on the host, RGBA in 8 bits.
  void offer(std::span<const std::uint8_t> rgba, glm::ivec2 size);
  /// On the showing thread: the newest picture, which stays as it is until the next call.
  SharedPicture newest();

 private:
  SharedPicture& free_slot(glm::ivec2 size);
  void offer_free_slot();

  std::array<SharedPicture, 3> slots_;
  int shown_ = 0, ready_ = 1, free_ = 2;
  bool fresh_ = false;  ///< slot ready_ is newer than slot shown_
  std::mutex mutex_;
};

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
