// SPDX-License-Identifier: BSD-3-Clause
// Renders text with FreeType, as coverage of pixels or as outlines.
#include "core/render/lettering.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

struct FontFile {
  const char *regular, *bold;
};
constexpr std::array<FontFile, 6> kFonts{{
    {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"},
    {"/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf", "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans-Bold.ttf"},
    {"/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans-Bold.ttf"},
    {"/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
     "/usr/share/fonts/truetype/liberation/LiberationSans-Bold.ttf"},
    {"/usr/share/fonts/truetype/liberation2/LiberationSans-Regular.ttf",
     "/usr/share/fonts/truetype/liberation2/LiberationSans-Bold.ttf"},
    {"/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf", "/usr/share/fonts/truetype/noto/NotoSans-Bold.ttf"},
}};

bool exists(const char* file) {
  std::error_code ignored;
  return std::filesystem::exists(path_of_text(file), ignored);
}

const FontFile* find_font() {
  const auto* const found = std::ranges::find_if(kFonts, [](const FontFile& font) { return exists(font.regular); });
  return found == kFonts.end() ? nullptr : found;
}

}  // namespace

struct Font::Face {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  ~Face() {
    if (face) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }

  /// Calls visit(left edge of the letter's box) for each letter of the text, after loading the letter into the face's
  /// slot. Returns the width of the text. Letters are placed on whole pixels, which hinting requires.
  int for_each_letter(std::string_view text, const auto& visit) const {
    return for_each_place(text, [&](int x, char32_t) { visit(x + face->glyph->bitmap_left); });
  }

  /// Calls visit(start of the advance, letter) for each letter of the text in the same way.
  int for_each_place(std::string_view text, const auto& visit) const {
    long x = 0;
    while (!text.empty()) {
      const Character character = first_character(text);
      text.remove_prefix(std::max<std::size_t>(character.bytes, 1));
      const char32_t letter = character.bytes == 0 ? U'?' : character.code;
      if (FT_Load_Char(face, letter, FT_LOAD_RENDER) != 0) continue;
      const long advance = face->glyph->advance.x;
      visit(static_cast<int>(x / 64), letter);
      x += advance;
    }
    return static_cast<int>((x + 63) / 64);
  }
};

namespace {

/// Converts a letter's outline, with y upwards and units of 1/64 pixel, to a path.
class OutlinePath {
 public:
  OutlinePath(std::vector<PathStep>& path, const glm::dvec2& origin) : path_(path), origin_(origin) {}

  void add(FT_Outline& outline) {
    FT_Outline_Funcs steps{};
    steps.move_to = [](const FT_Vector* to, void* self) { return static_cast<OutlinePath*>(self)->move(*to); };
    steps.line_to = [](const FT_Vector* to, void* self) { return static_cast<OutlinePath*>(self)->line(*to); };
    steps.conic_to = [](const FT_Vector* handle, const FT_Vector* to, void* self) {
      return static_cast<OutlinePath*>(self)->conic(*handle, *to);
    };
    steps.cubic_to = [](const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* self) {
      return static_cast<OutlinePath*>(self)->cubic(*first, *second, *to);
    };
    FT_Outline_Decompose(&outline, &steps, this);
    close();
  }

 private:
  glm::dvec2 place(const FT_Vector& point) const {
    return origin_ + glm::dvec2(static_cast<double>(point.x), -static_cast<double>(point.y)) / 64.0;
  }
  void close() {
    if (is_open_) path_.push_back({PathStep::Kind::close, {}});
    is_open_ = false;
  }
  int move(const FT_Vector& to) {
    close();
    is_open_ = true;
    last_ = place(to);
    path_.push_back({PathStep::Kind::move, {last_}});
    return 0;
  }
  int line(const FT_Vector& to) {
    last_ = place(to);
    path_.push_back({PathStep::Kind::line, {last_}});
    return 0;
  }
  int conic(const FT_Vector& handle, const FT_Vector& to) {
    const glm::dvec2 middle = place(handle), end = place(to);
    path_.push_back({PathStep::Kind::curve, {(last_ + 2.0 * middle) / 3.0, (end + 2.0 * middle) / 3.0, end}});
    last_ = end;
    return 0;
  }
  int cubic(const FT_Vector& first, const FT_Vector& second, const FT_Vector& to) {
    last_ = place(to);
    path_.push_back({PathStep::Kind::curve, {place(first), place(second), last_}});
    return 0;
  }

  std::vector<PathStep>& path_;
  glm::dvec2 origin_, last_{0.0};
  bool is_open_ = false;
};

}  // namespace

std::optional<std::string> find_font_file() {
  const FontFile* const font = find_font();
  return font ? std::optional<std::string>(font->regular) : std::nullopt;
}

Font::Font(int height, Weight weight) : face_(std::make_unique<Face>()), height_(height) {
  const FontFile* const font = find_font();
  if (!font)
    throw RequestError("no font was found for legends, labels and scale bars; install the package fonts-dejavu-core");
  const char* const file = weight == Weight::bold && exists(font->bold) ? font->bold : font->regular;
  if (FT_Init_FreeType(&face_->library) != 0 || FT_New_Face(face_->library, file, 0, &face_->face) != 0 ||
      FT_Set_Pixel_Sizes(face_->face, 0, static_cast<FT_UInt>(height)) != 0)
    throw RequestError(std::string(file) + ": this font cannot be read; install the package fonts-dejavu-core again");
  face_->for_each_letter("H", [&](int) { capital_height_ = face_->face->glyph->bitmap_top; });
}

Font::Font(Font&&) noexcept = default;
Font& Font::operator=(Font&&) noexcept = default;
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

std::vector<PathStep> Font::outline(std::string_view text, glm::ivec2 place) const {
  std::vector<PathStep> path;
  const int baseline = place.y + (capital_height_ + 1) / 2;
  face_->for_each_place(text, [&](int x, char32_t letter) {
    // Hinting is for pixels; letters have the same places with it.
    if (FT_Load_Char(face_->face, letter, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0) return;
    OutlinePath(path, glm::dvec2(place.x + x, baseline)).add(face_->face->glyph->outline);
  });
  return path;
}

std::string drawable(std::string_view text, int most_characters) {
  const std::string safe = escaped(text);
  std::string result;
  int count = 0;
  for (std::string_view rest = safe; !rest.empty(); ++count) {
    if (count == most_characters) return result + "…";
    const std::size_t bytes = first_character(rest).bytes;
    result += rest.substr(0, bytes);
    rest.remove_prefix(bytes);
  }
  return result.find_first_not_of(' ') == std::string::npos ? "(blank)" : result;
}

}  // namespace meniscus
