// SPDX-License-Identifier: BSD-3-Clause
// Text as pixels and as outlines, by FreeType.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace meniscus {

enum class Weight { regular, bold };

/// The first of DejaVu Sans, Liberation Sans and Noto Sans in the places where Linux distributions keep them.
std::optional<std::string> find_font_file();

/// A step of a path: where it goes, in pixels from the top left.
struct PathStep {
  enum class Kind { move, line, curve, close } kind;
  std::array<glm::dvec2, 3> points{};  ///< move and line: the first; a cubic curve: its two handles, then its end
};

/// One face and size of letters. Text is UTF-8.
class Font {
 public:
  /// height: of a line's letters, in pixels. bold: if the font has such letters. Throws RequestError when there is no
  /// font file, naming the package to install.
  explicit Font(int height, Weight weight = Weight::regular);
  Font(Font&&) noexcept;
  Font& operator=(Font&&) noexcept;
  ~Font();

  int height() const { return height_; }
  /// Pixels from the start of the text to its end.
  int width(std::string_view text) const;

  /// Draws text into `mask`, rows of `size`.x shares of coverage in [0, 1], from the left of `place`; its capitals are
  /// centred on the row place.y. What lies outside is cut off.
  void draw(std::string_view text, glm::ivec2 place, std::vector<float>& mask, glm::ivec2 size) const;

  /// The same letters as closed paths, filled where they wind around a point (non-zero).
  std::vector<PathStep> outline(std::string_view text, glm::ivec2 place) const;

 private:
  struct Face;
  std::unique_ptr<Face> face_;
  int height_;
  int capital_height_ = 0;
};

/// Text of a foreign file made fit to be drawn: escaped, at most so many characters and then an ellipsis; "(blank)" for
/// nothing.
std::string drawable(std::string_view text, int most_characters = 24);

}  // namespace meniscus
