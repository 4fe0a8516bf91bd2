// SPDX-License-Identifier: BSD-3-Clause
// A legend next to the molecule: a bar with numbers, or named swatches, that explain its colours.
#pragma once

#include "core/color/color_key.h"
#include "core/render/lettering.h"
#include "core/render/picture.h"

namespace meniscus {

/// A text that begins at `place` and is vertically centred on it. Lengths are in pixels.
struct LegendText {
  std::string text;
  glm::ivec2 place{0};

  bool operator==(const LegendText&) const = default;
};

/// A framed rectangle of one colour, or of as many as it has pixels along its longer side.
struct LegendBox {
  glm::ivec2 low{0}, high{0};     ///< first pixel and one past the last
  std::vector<glm::vec3> colors;  ///< sRGB; from the left or from the bottom

  bool operator==(const LegendBox&) const = default;
};

/// The requested properties of a legend, apart from the meaning of the colours.
struct LegendStyle {
  enum class Place { automatic, right, below };
  std::optional<std::string> title;  ///< replaces the title and unit of the key; may be empty
  std::optional<int> letters;        ///< height of letters, pixels
  Place place = Place::automatic;    ///< automatic: below in pictures higher than wide
  std::vector<std::string> names{};  ///< "A=Alpha" names the entry A Alpha
  std::optional<glm::vec3> color{};  ///< LetterStyle::color
  FontChoice font{};                 ///< LetterStyle::font
  int border = 0;                    ///< LetterStyle::border
};

/// A legend occupies a strip at the right or at the bottom of a picture. The molecule is framed in the rest, so the
/// legend covers nothing of it. Letters are 1/30 of the picture's shorter side, at least 9 pixels, unless set
/// otherwise; they shrink to 6 pixels if the legend would not fit. Entries are arranged in as many columns as they
/// need. Entries that do not fit are counted ("+5 more").
class Legend {
 public:
  /// Throws RequestError if the picture is too small for the legend, if a name is for an entry that does not exist, or
  /// if there is no font.
  Legend(const ColorKey& key, glm::ivec2 picture_size, const LegendStyle& style = {});

  /// Returns the size of the molecule's part of the picture, which is at the top left.
  glm::ivec2 molecule_size() const { return molecule_size_; }
  glm::ivec2 picture_size() const { return picture_size_; }

  /// Returns the texts and boxes with their places in the picture.
  const std::vector<LegendText>& texts() const { return texts_; }
  const std::vector<LegendBox>& boxes() const { return boxes_; }
  const Font& font() const { return font_; }
  int frame_width() const { return std::max(1, font_.height() / 16); }  ///< width of frames around boxes
  Inks inks(const std::optional<glm::vec3>& background) const { return inks_on(background, color_); }

  /// Returns the whole picture: `molecule`, of molecule_size(), and the legend. On a background letters are dark or
  /// light, for contrast; on none (transparent) they are dark, as for paper. The AOVs of the strip are the values of a
  /// miss.
  Framebuffer add_to(const Framebuffer& molecule, const std::optional<glm::vec3>& background) const;

  /// Returns `count` rows from `first` on of the whole picture. molecule: the rows among them that the molecule's
  /// picture has. layers: the layers of the result.
  Framebuffer rows(const Framebuffer& molecule, int first, int count, const PictureLayers& layers,
                   const std::optional<glm::vec3>& background) const;

  /// Returns the legend as a picture of its own, with a margin of half the height of its letters. The picture is empty
  /// if there is nothing to explain.
  Framebuffer alone(const std::optional<glm::vec3>& background) const;

 private:
  /// An entry of the list: a class of atoms with a box of its colour, or, for the other schemes of a picture, a title
  /// without a box, or a scale with a small bar.
  struct Entry {
    enum class Kind { box, title, bar };
    std::string name;
    glm::vec3 color;
    Kind kind = Kind::box;
    std::optional<ColorScale> bar{};
  };

  int line() const { return (3 * font_.height() + 1) / 2; }
  void add_entries(const ColorKey& key, bool is_first);
  void rename_entries(const std::vector<std::string>& names);
  bool lay_out(bool at_right, int letters, bool may_drop);
  bool lay_out_right(bool may_drop);
  bool lay_out_bottom(bool may_drop);
  void add_entry(const Entry& entry, glm::ivec2 place);
  void add_bar(glm::ivec2 low, glm::ivec2 high, bool upright);
  int box_width(const Entry& entry) const;
  int entry_width(const Entry& entry) const;
  bool keep_entries(std::size_t most, bool may_drop);
  void shorten_entries(int most_pixels);
  void shift_to(glm::ivec2 place);

  std::string title_;
  std::optional<ColorScale> bar_;  ///< nothing if the colours are classes
  std::vector<Entry> all_;
  std::vector<Entry> entries_;  ///< the entries that fit
  std::optional<glm::vec3> color_;
  FontChoice font_choice_;
  int border_;
  Font font_;
  glm::ivec2 picture_size_, molecule_size_;
  std::vector<LegendText> texts_;
  std::vector<LegendBox> boxes_;
};

/// Returns a picture of `size` with `part` at the left from row `top` on, transparent around it. The AOVs there are the
/// values of a miss.
Framebuffer with_margin(const Framebuffer& part, glm::ivec2 size, int top, const PictureLayers& layers);

/// Returns at most `most` multiples of 1, 2 or 5 times a power of ten between two numbers, exclusive, ascending.
std::vector<double> round_numbers(double low, double high, int most);

}  // namespace meniscus
