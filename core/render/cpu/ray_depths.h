// SPDX-License-Identifier: BSD-3-Clause
// How far the rays of a block can see, so that nothing beyond is made.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/math/ball.h"
#include "core/render/picture_block.h"

namespace meniscus {

/// A depth for each pixel of a block, beyond which none of its samples shows anything: Å from the camera (orthographic:
/// from its plane). At first all are infinite.
class RayDepths {
 public:
  /// frame: as it is when a block begins; it must stay as long.
  explicit RayDepths(const PictureFrame& frame) : frame_(frame) {}

  void begin(const PictureBlock& block, int samples);

  /// A ball that lies within an opaque solid whose outside the camera is in: rays that go well into it have met the
  /// solid by then. On several threads at once; counts from the next gather() on.
  void add_ball(const Ball& ball);
  /// No sample of this pixel of the block sees farther. Counts from the next gather() on.
  void limit(glm::ivec2 pixel, double depth);
  void gather();

  /// False only if nothing that lies within a bound (Primitive::bound) and begins there (Primitive::nearest) can show.
  bool may_show(const glm::vec4& bound, float nearest) const;

 private:
  glm::dvec2 on_pivot_plane(glm::ivec2 pixel, glm::dvec2 offset) const;
  double squared_distance(const glm::dvec3& point, const glm::dvec2& through) const;
  void add_to_pixels(const glm::dvec3& center, double radius, const glm::ivec4& pixels);
  void add_to_rays(const glm::dvec3& center, double radius, const glm::ivec4& pixels);
  bool may_show(int level, glm::ivec2 cell, const glm::ivec4& pixels, float nearest) const;
  bool meets_ray(const glm::vec4& bound, const glm::ivec4& pixels, float nearest) const;
  std::size_t at(glm::ivec2 pixel) const { return static_cast<std::size_t>(pixel.y) * block_.size.x + pixel.x; }

  /// Of 2^n x 2^n pixels each the farthest.
  struct Level {
    glm::ivec2 size{0};
    std::vector<float> depths;
  };

  const PictureFrame& frame_;
  PictureBlock block_;
  int samples_ = 0;
  kernel::TileListParameters pixels_{};  // of tiles as large as a pixel
  std::vector<float> rays_;              // of each sample, pixel by pixel; empty where there are too many
  std::vector<Level> levels_;            // the first has the pixels
};

}  // namespace meniscus
