// SPDX-License-Identifier: BSD-3-Clause
// A legend beside the molecule: a bar with numbers, or named swatches, that explain its colours.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/color/color_key.h"
#include "core/render/lettering.h"
#include "core/render/picture.h"

namespace meniscus {

/// Text that begins at `place`, vertically centred on it. Pixels.
struct LegendText {
  std::string text;
  glm::ivec2 place{0};
};

/// A framed rectangle of one colour, or of as many as it has pixels along its longer side.
struct LegendBox {
  glm::ivec2 low{0}, high{0};     ///< first pixel and one past the last
  std::vector<glm::vec3> colors;  ///< sRGB; from the left, or from the bottom
};

/// What is asked of a legend beyond what the colours mean.
struct LegendStyle {
  enum class Place { automatic, right, below };
  std::optional<std::string> title;  ///< instead of the key's title and unit; may be empty
  std::optional<int> letters;        ///< their height, pixels
  Place place = Place::automatic;    ///< automatic: below in pictures higher than wide
  std::vector<std::string> names{};  ///< "A=Alpha": the entry A is called Alpha
  std::optional<glm::vec3> color{};  ///< LetterStyle::color
};

/// The legend takes a strip at the right of a picture or at its bottom; the molecule is framed in the rest, so nothing
/// of it is covered. Letters are a thirtieth of the picture's shorter side, at least 9 pixels, unless set otherwise;
/// smaller, down to 6 pixels, where not all would fit. Entries stand in as many columns as they need; what has no room
/// even so is counted ("+5 more").
class Legend {
 public:
  /// Throws RequestError when the picture is too small for it, for a name of an entry that is not there, or when there
  /// is no font.
  Legend(const ColorKey& key, glm::ivec2 picture_size, const LegendStyle& style = {});

  /// Pixels left for the molecule, at the top left.
  glm::ivec2 molecule_size() const { return molecule_size_; }
  glm::ivec2 picture_size() const { return picture_size_; }

  /// What is drawn, and where in the picture.
  const std::vector<LegendText>& texts() const { return texts_; }
  const std::vector<LegendBox>& boxes() const { return boxes_; }
  const Font& font() const { return font_; }
  int frame_width() const { return std::max(1, font_.height() / 16); }  ///< around boxes
  Inks inks(const std::optional<glm::vec3>& background) const { return inks_on(background, color_); }

  /// The whole picture: `molecule`, of molecule_size(), and the legend. On a background letters are dark or light,
  /// whichever it needs; on none (transparent) they are dark, as for paper. AOVs of the strip are those of a miss.
  Framebuffer add_to(const Framebuffer& molecule, const std::optional<glm::vec3>& background) const;

  /// The same of `count` rows from `first` on. molecule: those of them that the molecule's picture has. aovs: whether
  /// it has any.
  Framebuffer rows(const Framebuffer& molecule, int first, int count, const PictureLayers& layers,
                   const std::optional<glm::vec3>& background) const;

  /// The legend as a picture of its own, with a margin half as wide as its letters are high. Empty if there is nothing
  /// to say.
  Framebuffer alone(const std::optional<glm::vec3>& background) const;

 private:
  /// A class of atoms; of what others colour by also its title, which has no box, and its scale as a small bar.
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
  std::optional<ColorScale> bar_;  ///< unless colours are of classes
  std::vector<Entry> all_;
  std::vector<Entry> entries_;  ///< those that have room
  std::optional<glm::vec3> color_;
  Font font_;
  glm::ivec2 picture_size_, molecule_size_;
  std::vector<LegendText> texts_;
  std::vector<LegendBox> boxes_;
};

/// `part` at the left of a picture of `size`, from row `top` on; nothing around it. AOVs there are those of a miss.
Framebuffer with_margin(const Framebuffer& part, glm::ivec2 size, int top, const PictureLayers& layers);

/// At most so many multiples of 1, 2 or 5 times a power of ten between two numbers, without these, ascending.
std::vector<double> round_numbers(double low, double high, int most);

}  // namespace meniscus
