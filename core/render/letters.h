// SPDX-License-Identifier: BSD-3-Clause
// How high and of what colour letters, lines and bars in a picture are.
#pragma once

#include <algorithm>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/image/color_space.h"

namespace meniscus {

/// What a user says about them. Heights are in pixels; nothing: by the size of the picture.
struct LetterStyle {
  std::optional<glm::vec3> color;  ///< sRGB in [0, 1]; nothing: dark or light, as the background needs
  std::optional<int> all;          ///< of what has no height of its own
  std::optional<int> labels, scale_bar, panel;
};

/// Heights of all that is written beside and over the molecule, pixels.
struct LetterHeights {
  int usual;   ///< of the time and of the curve's title
  int labels;  ///< and so on
  int scale_bar, panel, title;
  int small;  ///< of the numbers at the ends of the curve

  /// In a picture of this size without its legend.
  LetterHeights(const LetterStyle& style, glm::ivec2 size) {
    const int side = std::min(size.x, size.y);
    usual = style.all.value_or(std::max(9, side / 25));
    labels = style.labels.value_or(usual);
    scale_bar = style.scale_bar.value_or(usual);
    panel = style.panel.value_or(style.all ? 3 * *style.all / 2 : std::max(12, side / 16));
    title = style.all ? *style.all : std::max(10, side / 20);
    small = style.all ? std::max(6, 7 * *style.all / 10) : std::max(8, side / 36);
  }
};

/// Of letters, lines and bars, and of the rim that sets them off from the molecule behind them; sRGB.
struct Inks {
  glm::vec3 ink, rim;
};

/// Relative luminance of a colour (IEC 61966-2-1) beyond which it is light: where black and white letters on it have
/// the same contrast ratio (WCAG 2.1).
inline bool is_light(const glm::vec3& color) {
  return glm::dot(linear_from_srgb(color), glm::vec3(0.2126f, 0.7152f, 0.0722f)) > 0.179f;
}

/// color: of the letters; nothing: dark or light, as the background needs, and dark where there is none, as for paper.
inline Inks inks_on(const std::optional<glm::vec3>& background, const std::optional<glm::vec3>& color) {
  const bool is_dark = color ? !is_light(*color) : !background || is_light(*background);
  return {color.value_or(glm::vec3(is_dark ? 0.07f : 0.95f)), glm::vec3(is_dark ? 1.0f : 0.0f)};
}

}  // namespace meniscus
