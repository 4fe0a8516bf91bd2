// SPDX-License-Identifier: BSD-3-Clause
// Draws a legend into the picture it was laid out for.
#include "core/render/legend.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/image/color_space.h"
#include "core/render/ink.h"

namespace meniscus {
namespace {

/// `part` at the top left of a picture of `size`, nothing around it.
Framebuffer with_margin(const Framebuffer& part, glm::ivec2 size) {
  Framebuffer whole;
  whole.size = size;
  const auto widen = [&](auto& to, const auto& from, auto empty) {
    if (from.empty()) return;
    to.assign(static_cast<std::size_t>(size.x) * size.y, empty);
    for (int y = 0; y < part.size.y; ++y)
      std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(y) * part.size.x, part.size.x,
                  to.begin() + static_cast<std::ptrdiff_t>(y) * size.x);
  };
  widen(whole.color, part.color, glm::vec4(0.0f));
  widen(whole.z, part.z, std::numeric_limits<float>::infinity());
  widen(whole.normal, part.normal, glm::vec3(0.0f));
  widen(whole.position, part.position, glm::vec3(0.0f));
  widen(whole.atom, part.atom, kNone);
  widen(whole.kind, part.kind, kNone);
  widen(whole.component, part.component, kNone);
  return whole;
}

/// Lays a colour over a premultiplied pixel.
void cover(glm::vec4& pixel, const glm::vec3& linear, float share) {
  pixel = glm::vec4(linear * share, share) + (1.0f - share) * pixel;
}

void fill(Framebuffer& picture, glm::ivec2 low, glm::ivec2 high, const auto& color_at) {
  low = glm::max(low, glm::ivec2(0));
  high = glm::min(high, picture.size);
  for (int y = low.y; y < high.y; ++y)
    for (int x = low.x; x < high.x; ++x)
      picture.color[static_cast<std::size_t>(y) * picture.size.x + x] = glm::vec4(color_at(x, y), 1.0f);
}

void draw_box(Framebuffer& picture, const LegendBox& box, const glm::vec3& frame, int frame_width) {
  if (box.colors.front().x < 0.0f) return;  // "+3 more" has no colour
  fill(picture, box.low - frame_width, box.high + frame_width, [&](int, int) { return frame; });
  const bool upright = box.high.y - box.low.y > box.high.x - box.low.x;
  fill(picture, box.low, box.high, [&](int x, int y) {
    const std::size_t along = static_cast<std::size_t>(upright ? box.high.y - 1 - y : x - box.low.x);
    return linear_from_srgb(box.colors[box.colors.size() == 1 ? 0 : along]);
  });
}

}  // namespace

Framebuffer Legend::add_to(const Framebuffer& molecule, const std::optional<glm::vec3>& background) const {
  assert(molecule.size == molecule_size_);
  Framebuffer picture = with_margin(molecule, picture_size_);
  const glm::vec3 ink = linear_from_srgb(ink_on(background));
  for (const LegendBox& box : boxes_) draw_box(picture, box, ink, std::max(1, font_.height() / 16));

  const glm::ivec2 corner =
      molecule_size_.x < picture_size_.x ? glm::ivec2(molecule_size_.x, 0) : glm::ivec2(0, molecule_size_.y);
  const glm::ivec2 size = picture_size_ - corner;
  std::vector<float> mask(static_cast<std::size_t>(size.x) * size.y, 0.0f);
  for (const LegendText& text : texts_) font_.draw(text.text, text.place - corner, mask, size);
  const auto lay_over = [&](const std::vector<float>& shares, const glm::vec3& color) {
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x)
        cover(picture.color[static_cast<std::size_t>(corner.y + y) * picture_size_.x + corner.x + x], color,
              shares[static_cast<std::size_t>(y) * size.x + x]);
  };
  lay_over(mask, ink);
  return picture;
}

Framebuffer Legend::alone(const std::optional<glm::vec3>& background) const {
  Framebuffer nothing;
  nothing.size = molecule_size_;
  nothing.color.assign(static_cast<std::size_t>(molecule_size_.x) * molecule_size_.y, glm::vec4(0.0f));
  const Framebuffer whole = add_to(nothing, background);
  const auto at = [&](int x, int y) { return whole.color[static_cast<std::size_t>(y) * whole.size.x + x]; };
  glm::ivec2 low = whole.size, high(0);
  for (int y = 0; y < whole.size.y; ++y)
    for (int x = 0; x < whole.size.x; ++x) {
      if (at(x, y).w == 0.0f) continue;
      low = glm::min(low, glm::ivec2(x, y));
      high = glm::max(high, glm::ivec2(x + 1, y + 1));
    }
  Framebuffer legend;
  if (high.x == 0) return legend;
  const int margin = std::max(1, font_.height() / 2);
  legend.size = high - low + 2 * margin;
  legend.color.assign(static_cast<std::size_t>(legend.size.x) * legend.size.y, glm::vec4(0.0f));
  for (int y = low.y; y < high.y; ++y)
    for (int x = low.x; x < high.x; ++x)
      legend.color[static_cast<std::size_t>(y - low.y + margin) * legend.size.x + (x - low.x + margin)] = at(x, y);
  return legend;
}

}  // namespace meniscus
