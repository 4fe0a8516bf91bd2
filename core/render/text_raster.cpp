// SPDX-License-Identifier: BSD-3-Clause
// Sets text by FreeType and blends its letters into pixels.
#include "core/render/text_raster.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

constexpr std::array<const char*, 6> kFonts{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                            "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                            "/usr/share/fonts/TTF/DejaVuSans.ttf",
                                            "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
                                            "/usr/share/fonts/truetype/liberation2/LiberationSans-Regular.ttf",
                                            "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"};

/// A character and the bytes it takes; 0 bytes where the text does not begin with UTF-8.
struct Character {
  char32_t code = 0;
  std::size_t length = 0;
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  if (byte(0) < 0x80) return {byte(0), 1};
  const std::size_t length = byte(0) >> 5 == 6 ? 2 : byte(0) >> 4 == 14 ? 3 : byte(0) >> 3 == 30 ? 4 : 0;
  if (length == 0 || length > text.size()) return {};
  char32_t code = byte(0) & (0x7fu >> length);
  for (std::size_t n = 1; n < length; ++n) {
    if (byte(n) >> 6 != 2) return {};
    code = code << 6 | (byte(n) & 0x3fu);
  }
  return {code, length};
}

}  // namespace

struct Font::Face {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  ~Face() {
    if (face) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }

  /// Calls visit(left edge of the letter's box) with each letter of the text loaded into the face's slot; returns the
  /// width of all. Letters are on whole pixels, as hinting wants them.
  int for_each_letter(std::string_view text, const auto& visit) const {
    long x = 0;
    while (!text.empty()) {
      const Character character = first_character(text);
      text.remove_prefix(std::max<std::size_t>(character.length, 1));
      if (FT_Load_Char(face, character.length == 0 ? U'?' : character.code, FT_LOAD_RENDER) != 0) continue;
      visit(static_cast<int>(x / 64) + face->glyph->bitmap_left);
      x += face->glyph->advance.x;
    }
    return static_cast<int>((x + 63) / 64);
  }
};

std::optional<std::string> find_font_file() {
  std::error_code ignored;
  const auto file =
      std::ranges::find_if(kFonts, [&](const char* f) { return std::filesystem::exists(path_of_text(f), ignored); });
  return file == kFonts.end() ? std::nullopt : std::optional<std::string>(*file);
}

Font::Font(int height) : face_(std::make_unique<Face>()), height_(height) {
  const std::optional<std::string> file = find_font_file();
  if (!file) throw RequestError("--legend: no font was found; install the package fonts-dejavu-core");
  if (FT_Init_FreeType(&face_->library) != 0 || FT_New_Face(face_->library, file->c_str(), 0, &face_->face) != 0 ||
      FT_Set_Pixel_Sizes(face_->face, 0, static_cast<FT_UInt>(height)) != 0)
    throw RequestError(*file + ": this font cannot be read; install the package fonts-dejavu-core again");
  face_->for_each_letter("H", [&](int) { capital_height_ = face_->face->glyph->bitmap_top; });
}

Font::~Font() = default;

int Font::width(std::string_view text) const {
  return face_->for_each_letter(text, [](int) {});
}

void Font::draw(std::string_view text, glm::ivec2 place, std::vector<float>& mask, glm::ivec2 size) const {
  const int baseline = place.y + (capital_height_ + 1) / 2;
  face_->for_each_letter(text, [&](int left) {
    const FT_GlyphSlot letter = face_->face->glyph;
    for (int row = 0; row < static_cast<int>(letter->bitmap.rows); ++row) {
      for (int column = 0; column < static_cast<int>(letter->bitmap.width); ++column) {
        const glm::ivec2 at(place.x + left + column, baseline - letter->bitmap_top + row);
        if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) continue;
        const float share = static_cast<float>(letter->bitmap.buffer[row * letter->bitmap.pitch + column]) / 255.0f;
        float& covered = mask[static_cast<std::size_t>(at.y) * size.x + at.x];
        covered = std::max(covered, share);
      }
    }
  });
}

std::string drawable(std::string_view text) {
  constexpr int kMostCharacters = 24;
  const std::string safe = escaped(text);
  std::string result;
  int count = 0;
  for (std::string_view rest = safe; !rest.empty(); ++count) {
    if (count == kMostCharacters) return result + "…";
    const std::size_t length = first_character(rest).length;
    result += length == 0 ? "?" : rest.substr(0, length);
    rest.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result.find_first_not_of(' ') == std::string::npos ? "(blank)" : result;
}

}  // namespace meniscus
