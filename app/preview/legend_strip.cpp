// SPDX-License-Identifier: BSD-3-Clause
// Draws the legend around nothing, and copies molecules into the hole.
#include "app/preview/legend_strip.h"

#include <algorithm>
#include <cstddef>

#include <glm/common.hpp>

#include "core/image/color_space.h"

namespace meniscus {

LegendStrip::LegendStrip(const ColorKey& key, glm::ivec2 size, const LegendStyle& style, const glm::vec3& background)
    : size_(size) {
  const Legend legend(key, size, style);
  molecule_size_ = legend.molecule_size();
  Framebuffer nothing;
  nothing.size = molecule_size_;
  nothing.color.assign(static_cast<std::size_t>(molecule_size_.x) * molecule_size_.y, glm::vec4(0.0f));
  const Framebuffer whole = legend.add_to(nothing, background);
  picture_.resize(4 * whole.color.size());
  display_bytes(whole.color, background, 4, picture_.data());
}

glm::ivec2 LegendStrip::whole_size(glm::ivec2 size) const {
  return size == molecule_size_ ? size_ : glm::max(size_ / 2, glm::ivec2(1));
}

std::vector<std::uint8_t> LegendStrip::around(std::span<const std::uint8_t> molecule, glm::ivec2 size) const {
  const glm::ivec2 whole = whole_size(size);
  const int step = whole == size_ ? 1 : 2;
  std::vector<std::uint8_t> picture(static_cast<std::size_t>(4) * whole.x * whole.y);
  for (int y = 0; y < whole.y; ++y) {
    for (int x = 0; x < whole.x; ++x) {
      std::uint8_t* const to = &picture[4 * (static_cast<std::size_t>(y) * whole.x + x)];
      if (x < size.x && y < size.y) {
        std::copy_n(&molecule[4 * (static_cast<std::size_t>(y) * size.x + x)], 4, to);
        continue;
      }
      for (std::size_t c = 0; c < 4; ++c) {
        int sum = 0;
        for (int n = 0; n < step * step; ++n)
          sum += picture_[4 * (static_cast<std::size_t>(step * y + n / step) * size_.x + step * x + n % step) + c];
        to[c] = static_cast<std::uint8_t>((sum + step * step / 2) / (step * step));
      }
    }
  }
  return picture;
}

}  // namespace meniscus
