// SPDX-License-Identifier: BSD-3-Clause
// Draws a legend into the picture it was laid out for.
#include "core/render/legend.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/constants.h"
#include "core/image/color_space.h"
#include "core/render/lettering.h"

namespace meniscus {
namespace {

/// Lays a colour over a premultiplied pixel.
void cover(glm::vec4& pixel, const glm::vec3& linear, float share) {
  pixel = glm::vec4(linear * share, share) + (1.0f - share) * pixel;
}

/// Fills a box of the whole picture as far as it lies in `rows`, whose first row is `first` there.
void fill(Framebuffer& rows, int first, glm::ivec2 low, glm::ivec2 high, const auto& color_at) {
  low = glm::max(low, glm::ivec2(0, first));
  high = glm::min(high, glm::ivec2(rows.size.x, first + rows.size.y));
  for (int y = low.y; y < high.y; ++y)
    for (int x = low.x; x < high.x; ++x)
      rows.color[static_cast<std::size_t>(y - first) * rows.size.x + x] = glm::vec4(color_at(x, y), 1.0f);
}

void draw_box(Framebuffer& rows, int first, const LegendBox& box, const glm::vec3& frame, int frame_width) {
  if (box.colors.front().x < 0.0f) return;  // "+3 more" has no colour
  fill(rows, first, box.low - frame_width, box.high + frame_width, [&](int, int) { return frame; });
  const bool upright = box.high.y - box.low.y > box.high.x - box.low.x;
  fill(rows, first, box.low, box.high, [&](int x, int y) {
    const std::size_t along = static_cast<std::size_t>(upright ? box.high.y - 1 - y : x - box.low.x);
    return linear_from_srgb(box.colors[box.colors.size() == 1 ? 0 : along]);
  });
}

}  // namespace

Framebuffer with_margin(const Framebuffer& part, glm::ivec2 size, int top, const PictureLayers& layers) {
  Framebuffer whole;
  whole.size = size;
  const auto widen = [&](auto& to, const auto& from, auto empty, std::ptrdiff_t each = 1) {
    to.assign(static_cast<std::size_t>(each) * size.x * size.y, empty);
    for (int y = 0; y < part.size.y; ++y)
      std::copy_n(from.begin() + each * y * part.size.x, each * part.size.x, to.begin() + each * (top + y) * size.x);
  };
  widen(whole.color, part.color, glm::vec4(0.0f));
  if (layers.rays > 0) widen(whole.seen, part.seen, kNone, layers.rays);
  if (!layers.aovs) return whole;
  if (layers.motion) widen(whole.motion, part.motion, glm::vec2(0.0f));
  widen(whole.z, part.z, std::numeric_limits<float>::infinity());
  widen(whole.normal, part.normal, glm::vec3(0.0f));
  widen(whole.position, part.position, glm::vec3(0.0f));
  widen(whole.atom, part.atom, kNone);
  widen(whole.kind, part.kind, kNone);
  widen(whole.component, part.component, kNone);
  return whole;
}

Framebuffer Legend::add_to(const Framebuffer& molecule, const std::optional<glm::vec3>& background) const {
  assert(molecule.size == molecule_size_);
  return rows(molecule, 0, picture_size_.y, layers_of(molecule), background);
}

Framebuffer Legend::rows(const Framebuffer& molecule, int first, int count, const PictureLayers& layers,
                         const std::optional<glm::vec3>& background) const {
  assert(molecule.size.y == std::clamp(molecule_size_.y - first, 0, count));
  Framebuffer picture = with_margin(molecule, {picture_size_.x, count}, 0, layers);
  const glm::vec3 ink = linear_from_srgb(inks(background).ink);
  for (const LegendBox& box : boxes_) draw_box(picture, first, box, ink, frame_width());

  const bool at_right = molecule_size_.x < picture_size_.x;
  const glm::ivec2 corner(at_right ? molecule_size_.x : 0, std::max(at_right ? 0 : molecule_size_.y, first));
  const glm::ivec2 size = glm::max(glm::ivec2(picture_size_.x, first + count) - corner, glm::ivec2(0));
  std::vector<float> mask(static_cast<std::size_t>(size.x) * size.y, 0.0f);
  for (const LegendText& text : texts_)
    if (std::abs(2 * (text.place.y - corner.y) - size.y) <= size.y + 4 * font_.height())
      font_.draw(text.text, text.place - corner, mask, size);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      cover(picture.color[static_cast<std::size_t>(corner.y - first + y) * picture_size_.x + corner.x + x], ink,
            mask[static_cast<std::size_t>(y) * size.x + x]);
  return picture;
}

Framebuffer Legend::alone(const std::optional<glm::vec3>& background) const {
  constexpr int kTogether = 64;  // rows; the whole picture may be too large for the memory
  const auto for_each_pixel = [&](const auto& work) {
    for (int first = 0; first < picture_size_.y; first += kTogether) {
      const int count = std::min(kTogether, picture_size_.y - first);
      Framebuffer nothing;
      nothing.size = {molecule_size_.x, std::clamp(molecule_size_.y - first, 0, count)};
      nothing.color.assign(static_cast<std::size_t>(nothing.size.x) * nothing.size.y, glm::vec4(0.0f));
      const Framebuffer some = rows(nothing, first, count, false, background);
      for (int y = 0; y < count; ++y)
        for (int x = 0; x < picture_size_.x; ++x) {
          const glm::vec4& pixel = some.color[static_cast<std::size_t>(y) * picture_size_.x + x];
          if (pixel.w > 0.0f) work(glm::ivec2(x, first + y), pixel);
        }
    }
  };
  glm::ivec2 low = picture_size_, high(0);
  for_each_pixel([&](glm::ivec2 at, const glm::vec4&) {
    low = glm::min(low, at);
    high = glm::max(high, at + 1);
  });
  Framebuffer legend;
  if (high.x == 0) return legend;
  const int margin = std::max(1, font_.height() / 2);
  legend.size = high - low + 2 * margin;
  legend.color.assign(static_cast<std::size_t>(legend.size.x) * legend.size.y, glm::vec4(0.0f));
  for_each_pixel([&](glm::ivec2 at, const glm::vec4& pixel) {
    const glm::ivec2 place = at - low + margin;
    legend.color[static_cast<std::size_t>(place.y) * legend.size.x + place.x] = pixel;
  });
  return legend;
}

}  // namespace meniscus
