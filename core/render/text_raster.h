// SPDX-License-Identifier: BSD-3-Clause
// Text as pixels, by FreeType, in a colour that can be read.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/image/color_space.h"

namespace meniscus {

/// The first of DejaVu Sans, Liberation Sans and Noto Sans in the places where Linux distributions keep them.
std::optional<std::string> find_font_file();

/// One face and size of letters. Text is UTF-8.
class Font {
 public:
  /// height: of a line's letters, in pixels. Throws RequestError when there is no font file, naming the package to
  /// install.
  explicit Font(int height);
  ~Font();

  int height() const { return height_; }
  /// Pixels from the start of the text to its end.
  int width(std::string_view text) const;

  /// Draws text into `mask`, rows of `size`.x shares of coverage in [0, 1], from the left of `place`; its capitals are
  /// centred on the row place.y. What lies outside is cut off.
  void draw(std::string_view text, glm::ivec2 place, std::vector<float>& mask, glm::ivec2 size) const;

 private:
  struct Face;
  std::unique_ptr<Face> face_;
  int height_;
  int capital_height_ = 0;
};

/// Text of a foreign file made fit to be drawn: control characters escaped, bytes that are not UTF-8 as '?', at most 24
/// characters and then an ellipsis; "(blank)" for nothing.
std::string drawable(std::string_view text);

/// Whether letters on this sRGB background are dark; on none they are, as for paper. At the luminance (IEC 61966-2-1)
/// where it changes black and white letters have the same contrast ratio (WCAG 2.1).
inline bool is_ink_dark(const std::optional<glm::vec3>& background) {
  return !background || glm::dot(linear_from_srgb(*background), glm::vec3(0.2126f, 0.7152f, 0.0722f)) > 0.179f;
}

/// Of letters, sRGB; and of a rim around them that sets them off from what is behind.
inline glm::vec3 ink_on(const std::optional<glm::vec3>& background) {
  return glm::vec3(is_ink_dark(background) ? 0.07f : 0.95f);
}
inline glm::vec3 rim_on(const std::optional<glm::vec3>& background) {
  return glm::vec3(is_ink_dark(background) ? 1.0f : 0.0f);
}

}  // namespace meniscus
