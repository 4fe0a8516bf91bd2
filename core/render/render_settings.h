// SPDX-License-Identifier: BSD-3-Clause
// What is wanted of a picture, whatever makes it.
#pragma once

#include <functional>

#include <glm/vec2.hpp>

#include "core/base/stage_clock.h"
#include "core/render/framebuffer.h"
#include "core/render/look.h"

namespace meniscus {

/// How a picture is made.
struct RenderSettings {
  glm::ivec2 size{1024, 768};  ///< pixels
  int samples = 1;             ///< rays per pixel, the first through its centre
  bool aovs = false;           ///< of render(): fill the AOV arrays too; for drawables with a surface()
  int block_edge = 2048;       ///< of render(): larger pictures are cast in blocks of at most this edge, in pixels
  Look look;                   ///< its background is that of draw(); render() leaves it transparent
  StageTiming timing = StageTiming::rough;
  /// Of render() on the CPU: called now and then on the thread that asked for the picture, with the share of it that is
  /// cast, from 0 to 1; what it throws ends the picture.
  std::function<void(double share)> progress{};
  /// Of render(): takes the picture in bands of whole rows, from the top, so that it is never in memory as a whole;
  /// what render() returns has its size and no pixels. Bands are pictures of their own, of rows from `first_row` on,
  /// and have the same pixels as the whole picture. What it throws ends the picture.
  std::function<void(Framebuffer band, int first_row)> take_band{};
};

}  // namespace meniscus
