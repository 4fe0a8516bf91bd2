// SPDX-License-Identifier: BSD-3-Clause
// What is written over a picture, in its pixels: texts, lines and boxes of one colour.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <variant>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "core/render/lettering.h"

namespace meniscus {

/// From the first pixel to one past the last.
struct PixelBox {
  glm::ivec2 low{0}, high{0};

  bool meets(const PixelBox& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
  }
  PixelBox grown(int by) const { return {low - by, high + by}; }
};

/// Begins at `place`, on which its capitals are centred.
struct InkText {
  std::string text;
  glm::ivec2 place;
  int height;  ///< of letters
  Weight weight = Weight::regular;
};

/// With round ends; a dot where both ends are the same.
struct InkLine {
  glm::dvec2 from, to;
  double width;
  double share = 1.0;  ///< of what is behind that it covers
};

using InkStroke = std::variant<InkText, InkLine, PixelBox>;

/// Fonts of several sizes, each opened once.
class FontShelf {
 public:
  /// Throws as Font does.
  const Font& at(int height, Weight weight = Weight::regular) {
    return fonts_.try_emplace({height, weight}, height, weight).first->second;
  }
  const Font& of(const InkText& text) { return at(text.height, text.weight); }

 private:
  std::map<std::pair<int, Weight>, Font> fonts_;
};

}  // namespace meniscus
