// SPDX-License-Identifier: BSD-3-Clause
// Finds fonts, and lays out and renders text with FreeType.
#include "core/render/lettering.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_FONT_FORMATS_H
#include FT_OUTLINE_H

#include <cctype>
#include <cmath>
#include <initializer_list>

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

/// The files of the weights of a font. bold: empty if there is none.
struct FontFiles {
  std::string regular, bold;
};

/// Returns the letters and digits of a name in lower case, by which names of fonts are compared.
std::string plain_name(std::string_view text) {
  std::string name;
  for (const unsigned char c : text)
    if (std::isalnum(c) != 0) name += static_cast<char>(std::tolower(c));
  return name;
}

constexpr std::string_view kBuiltIn = "built-in:";  // begins the paths of built-in fonts

/// Returns the bytes of a built-in font; nothing if `file` is another path.
std::string_view built_in_bytes(std::string_view file) {
  for (const BuiltInFont& font : built_in_fonts())
    if (file.starts_with(kBuiltIn) && file.ends_with(font.name)) return font.bytes;
  return {};
}

bool is_font_file(const std::filesystem::path& path) {
  const std::string extension = plain_name(text_of_path(path.extension()));
  return extension == "ttf" || extension == "otf";
}

/// Returns the names and paths of all installed and built-in fonts, sorted.
const std::map<std::string, std::string>& installed_fonts() {
  namespace fs = std::filesystem;
  static const std::map<std::string, std::string> installed = [] {
    std::map<std::string, std::string> fonts;
    std::error_code ignored;
    for (const char* const folder : {"/usr/local/share/fonts", "/usr/share/fonts"})
      for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, ignored), end;
           at != end; at.increment(ignored))
        if (const std::string path = text_of_path(at->path()); is_font_file(at->path())) {
          std::string& known = fonts[plain_name(text_of_path(at->path().stem()))];
          if (known.empty() || path < known) known = path;
        }
    for (const BuiltInFont& font : built_in_fonts())
      fonts[plain_name(font.name.substr(0, font.name.rfind('.')))] = std::string(kBuiltIn).append(font.name);
    return fonts;
  }();
  return installed;
}

/// Returns the regular and the bold font file of an installed family. The family is recognised by the names of its
/// files: "DejaVu Sans" has DejaVuSans.ttf and DejaVuSans-Bold.ttf. Both are empty if it is not installed.
FontFiles family_files(std::string_view family) {
  const auto first_of = [&](std::initializer_list<const char*> styles) -> std::string {
    for (const char* const style : styles)
      if (const auto found = installed_fonts().find(plain_name(family) + style); found != installed_fonts().end())
        return found->second;
    return {};
  };
  return {first_of({"regular", "", "book", "roman"}), first_of({"bold", "bd"})};
}

/// Returns the fonts in which letters are looked up, the chosen one first. Throws RequestError.
std::vector<FontFiles> fonts_for(const FontChoice& choice) {
  std::vector<FontFiles> fonts;
  if (!choice.file.empty()) {
    if (!is_font_file(path_of_text(choice.file)))
      throw RequestError(message("@font-file {}@ is not a .ttf or .otf file", in_quotes(choice.file)));
    fonts.push_back({choice.file, ""});
  } else if (!choice.family.empty()) {
    fonts.push_back(family_files(choice.family));
    if (fonts.front().regular.empty())
      throw RequestError(
          message("@font {}@: no font of this family is in /usr/share/fonts or /usr/local/share/fonts; "
                  "`fc-list : family` lists families, and @font-file@ takes a file",
                  in_quotes(choice.family)));
  }
  for (const char* const family : {"Liberation Sans", "DejaVu Sans", "Noto Sans"})
    if (FontFiles files = family_files(family); !files.regular.empty()) fonts.push_back(std::move(files));
  if (fonts.empty())
    throw RequestError("no font was found for legends, labels and scale bars; install the package fonts-liberation2");
  return fonts;
}

std::shared_ptr<const FontProgram> program_of(FT_Face face, const std::string& file) {
  const auto thousandths = [face](long units) {
    return static_cast<int>(std::lround(1e3 * units / face->units_per_EM));
  };
  auto program = std::make_shared<FontProgram>();
  program->file = file;
  program->family = face->family_name ? face->family_name : "";
  const char* const name = FT_Get_Postscript_Name(face);
  program->postscript_name = name ? name : "Font";
  program->is_bold = (face->style_flags & FT_STYLE_FLAG_BOLD) != 0;
  program->is_cff = std::string_view(FT_Get_Font_Format(face)) == "CFF";
  program->may_be_embedded = (FT_Get_FSType_Flags(face) & FT_FSTYPE_RESTRICTED_LICENSE_EMBEDDING) == 0;
  program->box = {thousandths(face->bbox.xMin), thousandths(face->bbox.yMin), thousandths(face->bbox.xMax),
                  thousandths(face->bbox.yMax)};
  program->ascent = thousandths(face->ascender);
  program->descent = thousandths(face->descender);
  const bool has_capitals = FT_Load_Char(face, U'H', FT_LOAD_NO_SCALE) == 0;
  program->capital_height = has_capitals ? thousandths(face->glyph->metrics.horiBearingY) : program->ascent;
  return program;
}

}  // namespace

/// The fonts in which letters are looked up. The first one is open; others are opened when a letter needs them.
class Font::Faces {
 public:
  Faces(int height, Weight weight, const FontChoice& choice) : height_(height) {
    for (const FontFiles& font : fonts_for(choice))
      faces_.push_back({weight == Weight::bold && !font.bold.empty() ? font.bold : font.regular});
    if (FT_Init_FreeType(&library_) != 0) throw CapacityError("not enough memory for fonts");
    if (is_open(faces_.front())) return;
    FT_Done_FreeType(library_);
    throw RequestError(message("{}: this font cannot be read; install its package again, or choose another @font@",
                               in_quotes(faces_.front().file)));
  }
  ~Faces() { FT_Done_FreeType(library_); }  // closes the faces
  Faces(const Faces&) = delete;
  Faces& operator=(const Faces&) = delete;

  /// A letter in the slot of its face, as an outline in units of 1/64 pixel that is fitted to the rows of pixels.
  struct Loaded {
    FT_GlyphSlot slot;
    const std::shared_ptr<const FontProgram>& font;
    char32_t code;
    double x;  ///< distance from the start of the text, pixels
  };

  /// Calls visit(letter) for each letter of the text. Returns the width of the text in pixels.
  double for_each_letter(std::string_view text, const auto& visit) {
    double x = 0.0;
    const Face* last_face = nullptr;
    FT_UInt last_glyph = 0;
    while (!text.empty()) {
      const Character character = first_character(text);
      text.remove_prefix(std::max<std::size_t>(character.bytes, 1));
      const char32_t code = character.bytes == 0 ? U'?' : character.code;
      const Face& face = face_with(code);
      const FT_UInt glyph = FT_Get_Char_Index(face.face, code);
      if (FT_Load_Glyph(face.face, glyph, FT_LOAD_TARGET_LIGHT | FT_LOAD_NO_BITMAP) != 0) continue;
      FT_Vector kerning{};
      if (&face == last_face) FT_Get_Kerning(face.face, last_glyph, glyph, FT_KERNING_UNFITTED, &kerning);
      x += static_cast<double>(kerning.x) / 64.0;
      visit(Loaded{face.face->glyph, face.program, code, x});
      x += static_cast<double>(face.face->glyph->linearHoriAdvance) / 65536.0;
      last_face = &face;
      last_glyph = glyph;
    }
    return x;
  }

 private:
  struct Face {
    std::string file;
    FT_Face face = nullptr;
    bool is_tried = false;
    std::shared_ptr<const FontProgram> program{};
  };

  /// True if the file of the face is a font, which is opened at the first call.
  bool is_open(Face& face) {
    const std::string_view built_in = built_in_bytes(face.file);
    const auto open = [&] {
      return built_in.empty() ? FT_New_Face(library_, face.file.c_str(), 0, &face.face)
                              : FT_New_Memory_Face(library_, reinterpret_cast<const FT_Byte*>(built_in.data()),
                                                   static_cast<FT_Long>(built_in.size()), 0, &face.face);
    };
    if (!face.is_tried && open() == 0 && FT_Set_Pixel_Sizes(face.face, 0, static_cast<FT_UInt>(height_)) == 0)
      face.program = program_of(face.face, face.file);
    face.is_tried = true;
    return face.program != nullptr;
  }

  /// Returns the first face that has the letter, else the first face, which draws a box.
  const Face& face_with(char32_t code) {
    const auto has = [&](Face& face) { return is_open(face) && FT_Get_Char_Index(face.face, code) != 0; };
    const auto found = std::ranges::find_if(faces_, has);
    return found == faces_.end() ? faces_.front() : *found;
  }

  const int height_;
  FT_Library library_ = nullptr;
  std::vector<Face> faces_;
};

std::string font_bytes(const std::string& file) {
  const std::string_view built_in = built_in_bytes(file);
  return built_in.empty() ? read_file_bytes(file) : std::string(built_in);
}

Font::Font(int height, Weight weight, const FontChoice& choice)
    : faces_(std::make_unique<Faces>(height, weight, choice)), height_(height) {
  faces_->for_each_letter("H", [&](const Faces::Loaded& letter) {
    capital_height_ = static_cast<int>((letter.slot->metrics.horiBearingY + 63) / 64);
  });
}

Font::Font(Font&&) noexcept = default;
Font& Font::operator=(Font&&) noexcept = default;
Font::~Font() = default;

int Font::width(std::string_view text) const {
  return static_cast<int>(std::ceil(faces_->for_each_letter(text, [](const Faces::Loaded&) {})));
}

void Font::draw(std::string_view text, glm::ivec2 place, std::vector<float>& mask, glm::ivec2 size) const {
  faces_->for_each_letter(text, [&](const Faces::Loaded& letter) {
    const double whole = std::floor(letter.x);
    FT_Outline_Translate(&letter.slot->outline, std::lround(64.0 * (letter.x - whole)), 0);
    if (FT_Render_Glyph(letter.slot, FT_RENDER_MODE_NORMAL) != 0) return;
    const FT_Bitmap& bitmap = letter.slot->bitmap;
    const glm::ivec2 corner(place.x + static_cast<int>(whole) + letter.slot->bitmap_left,
                            baseline(place.y) - letter.slot->bitmap_top);
    for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
      for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
        const glm::ivec2 at = corner + glm::ivec2(column, row);
        if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) continue;
        const float share = static_cast<float>(bitmap.buffer[row * bitmap.pitch + column]) / 255.0f;
        float& covered = mask[static_cast<std::size_t>(at.y) * size.x + at.x];
        covered = std::max(covered, share);
      }
    }
  });
}

std::vector<PlacedLetter> Font::letters(std::string_view text) const {
  std::vector<PlacedLetter> letters;
  faces_->for_each_letter(text, [&](const Faces::Loaded& letter) {
    const double advance = static_cast<double>(letter.slot->linearHoriAdvance) / 65.536 / height_;
    letters.push_back({letter.font, letter.code, letter.slot->glyph_index, letter.x, advance});
  });
  return letters;
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
