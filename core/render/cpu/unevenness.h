// SPDX-License-Identifier: BSD-3-Clause
// Finds where a picture needs more than one sample per pixel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace meniscus {

/// The bundles (kBundleEdge) of a block in which the first sample of each pixel is not enough. Elsewhere colours change
/// so little and so evenly from pixel to pixel that the mean of all samples of a pixel differs from its first sample,
/// which is at its centre, by at most 1/255.
class Unevenness {
 public:
  /// True if a picture is so large that samples which are left out save a user's time: 1280 x 960 pixels or more.
  /// Smaller pictures are quick anyway. They have all samples, and differ from GL's pictures by rounding alone.
  static bool pays_off(glm::ivec2 size) { return std::int64_t{size.x} * size.y >= 1280 * 960; }

  /// Compares the pixels of a block with their neighbours. first: the finished first sample of each pixel, linear and
  /// premultiplied, row by row.
  void find(std::span<const glm::vec4> first, glm::ivec2 size);

  /// Returns 1 for each pixel of an uneven bundle and 0 for the other pixels, row by row, and a few more elements,
  /// which packets at the end of the block may read.
  const std::vector<float>& counts() const { return counts_; }

  /// True if all pixels of a rectangle are in even bundles. first, end: pixels of the block.
  bool is_even(glm::ivec2 first, glm::ivec2 end) const;

 private:
  glm::ivec2 size_{0};
  std::vector<float> counts_;
};

}  // namespace meniscus
