// SPDX-License-Identifier: BSD-3-Clause
// Letters, lines and boxes over a picture: their fonts, built in or not, heights and colours, and text as pixels and as
// glyphs.
#pragma once

#include <algorithm>
#include <compare>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/image/color_space.h"

namespace meniscus {

enum class Weight { regular, bold };

/// The font that a user chose. Both are empty for the default: the first installed one of Liberation Sans, which has
/// the widths of Arial, DejaVu Sans and Noto Sans.
struct FontChoice {
  std::string family;  ///< name of an installed family
  std::string file;    ///< path of a .ttf or .otf file

  auto operator<=>(const FontChoice&) const = default;
};

/// A font file with the properties that pages contain. Lengths are in thousandths of the height of its letters.
struct FontProgram {
  std::string file, family, postscript_name;
  bool is_bold = false, is_cff = false;  ///< is_cff: its outlines are in the Compact Font Format
  bool may_be_embedded = true;           ///< false if its licence forbids to embed it
  std::array<int, 4> box{};              ///< left, bottom, right and top of the box that contains all letters
  int ascent = 0, descent = 0, capital_height = 0;
};

/// A letter of a text.
struct PlacedLetter {
  std::shared_ptr<const FontProgram> font;
  char32_t code;
  std::uint32_t glyph;  ///< number of the letter in its font
  double x;             ///< distance from the start of the text, pixels
  double advance;       ///< distance to the next letter without kerning, in thousandths of the height
};

/// One face and size of letters. Text is UTF-8. Letters that the font does not have come from the default fonts.
class Font {
 public:
  /// Opens a font. height: height of a line's letters, pixels. A bold weight is used if the font has one. Throws
  /// RequestError if the chosen font does not exist or cannot be read, and if no font is installed; the message then
  /// names the package to install.
  explicit Font(int height, Weight weight = Weight::regular, const FontChoice& choice = {});
  Font(Font&&) noexcept;
  Font& operator=(Font&&) noexcept;
  ~Font();

  int height() const { return height_; }
  /// Returns the distance from the start of the text to its end, pixels.
  int width(std::string_view text) const;

  /// Draws text into `mask`, which has rows of `size`.x coverages in [0, 1]. The text begins at `place`, and its
  /// capitals are centred on the row place.y. Text outside of the mask is clipped.
  void draw(std::string_view text, glm::ivec2 place, std::vector<float>& mask, glm::ivec2 size) const;

  /// Returns the letters of the text in its order.
  std::vector<PlacedLetter> letters(std::string_view text) const;
  /// Returns the row of the baseline of a text whose capitals are centred on `row`.
  int baseline(int row) const { return row + (capital_height_ + 1) / 2; }

 private:
  class Faces;
  std::unique_ptr<Faces> faces_;
  int height_;
  int capital_height_ = 0;
};

/// Returns text of an untrusted file in a form that is safe to draw: escaped, at most most_characters and then an
/// ellipsis; "(blank)" for empty text.
std::string drawable(std::string_view text, int most_characters = 24);

/// The letters that a user requests. Heights are in pixels; nothing: the height follows from the size of the picture.
struct LetterStyle {
  std::optional<glm::vec3> color;  ///< sRGB in [0, 1]; nothing: dark or light, depending on the background
  std::optional<int> all;          ///< height of all texts without a height of their own
  std::optional<int> labels, scale_bar, panel;
  FontChoice font{};
  int border = 0;  ///< least distance of texts and bars from the border of the picture, pixels
};

/// Heights of all texts next to and over the molecule, pixels.
struct LetterHeights {
  int usual;   ///< height of the time and of the curve's title
  int labels;  ///< height of labels
  int scale_bar, panel, title;
  int small;  ///< height of the numbers at the ends of the curve

  /// Sets the heights for a picture of this size without its legend.
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

/// The colours of letters, lines and bars, and of the rim that sets them off from the molecule behind them; sRGB.
struct Inks {
  glm::vec3 ink, rim;
};

/// True if the relative luminance of a colour (IEC 61966-2-1) is above the value at which black and white letters on it
/// have the same contrast ratio (WCAG 2.1).
inline bool is_light(const glm::vec3& color) {
  return glm::dot(linear_from_srgb(color), glm::vec3(0.2126f, 0.7152f, 0.0722f)) > 0.179f;
}

/// Returns the colours for a background. color: colour of the letters; nothing: dark or light, depending on the
/// background, and dark without one, as for paper.
inline Inks inks_on(const std::optional<glm::vec3>& background, const std::optional<glm::vec3>& color) {
  const bool is_dark = color ? !is_light(*color) : !background || is_light(*background);
  return {color.value_or(glm::vec3(is_dark ? 0.07f : 0.95f)), glm::vec3(is_dark ? 1.0f : 0.0f)};
}

/// A rectangle from its first pixel to one past its last.
struct PixelBox {
  glm::ivec2 low{0}, high{0};

  bool meets(const PixelBox& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
  }
  PixelBox grown(int by) const { return {low - by, high + by}; }
};

/// A text that begins at `place`, on which its capitals are vertically centred.
struct InkText {
  std::string text;
  glm::ivec2 place;
  int height;  ///< height of letters
  Weight weight = Weight::regular;
};

/// A line with round ends; it is a dot if both ends are equal.
struct InkLine {
  glm::dvec2 from, to;
  double width;
  double share = 1.0;  ///< opacity of the line
};

using InkStroke = std::variant<InkText, InkLine, PixelBox>;

/// Sizes and weights of one font, each opened once.
class FontShelf {
 public:
  explicit FontShelf(FontChoice choice) : choice_(std::move(choice)) {}

  /// Returns the font of a height and weight, and opens it if necessary. Throws RequestError if there is no font file.
  const Font& at(int height, Weight weight = Weight::regular) {
    return fonts_.try_emplace({height, weight}, height, weight, choice_).first->second;
  }
  const Font& of(const InkText& text) { return at(text.height, text.weight); }

 private:
  FontChoice choice_;
  std::map<std::pair<int, Weight>, Font> fonts_;
};

/// A font file in memory. It counts as installed, and comes before a file of this name in the system.
struct BuiltInFont {
  std::string_view name, bytes;
};

/// Returns the files of Liberation Sans, regular and bold; none if they were missing when the library was built.
std::span<const BuiltInFont> built_in_fonts();

/// Returns the bytes of a font by FontProgram::file, which is the path of a file, or "built-in:" and the name of a
/// built-in font. Throws InputError if the file cannot be read.
std::string font_bytes(const std::string& file);

}  // namespace meniscus
