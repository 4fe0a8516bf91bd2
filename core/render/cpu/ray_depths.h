// SPDX-License-Identifier: BSD-3-Clause
// Computes how far the rays of a block can see, so that no primitives beyond are made.
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
/// from its plane). Initially all are infinite.
class RayDepths {
 public:
  /// Uses the frame of a picture, which is read at the start of each block and must outlive this object.
  explicit RayDepths(const PictureFrame& frame) : frame_(frame) {}

  void begin(const PictureBlock& block, int samples);

  /// Adds a ball inside an opaque solid that does not contain the camera: rays that enter the ball well have hit the
  /// solid before. Several threads may call it at once. It takes effect with the next gather().
  void add_ball(const Ball& ball);
  /// Declares that no sample of this pixel of the block sees farther. It takes effect with the next gather().
  void limit(glm::ivec2 pixel, double depth);
  void gather();

  /// Returns false only if nothing within a bound (Primitive::bound) that begins there (Primitive::nearest) can be
  /// visible.
  bool may_show(const glm::vec4& bound, float nearest) const;

 private:
  glm::dvec2 on_pivot_plane(glm::ivec2 pixel, glm::dvec2 offset) const;
  double squared_distance(const glm::dvec3& point, const glm::dvec2& through) const;
  void add_to_pixels(const glm::dvec3& center, double radius, const glm::ivec4& pixels);
  void add_to_rays(const glm::dvec3& center, double radius, const glm::ivec4& pixels);
  bool may_show(int level, glm::ivec2 cell, const glm::ivec4& pixels, float nearest) const;
  bool meets_ray(const glm::vec4& bound, const glm::ivec4& pixels, float nearest) const;
  std::size_t at(glm::ivec2 pixel) const { return static_cast<std::size_t>(pixel.y) * block_.size.x + pixel.x; }

  /// The farthest depth of each square of 2^n x 2^n pixels.
  struct Level {
    glm::ivec2 size{0};
    std::vector<float> depths;
  };

  const PictureFrame& frame_;
  PictureBlock block_;
  int samples_ = 0;
  kernel::TileListParameters pixels_{};  // parameters of tiles of one pixel
  std::vector<float> rays_;              // depth of each sample, pixel by pixel; empty if there are too many
  std::vector<Level> levels_;            // the first has single pixels
};

}  // namespace meniscus
