// SPDX-License-Identifier: BSD-3-Clause
// Writes PDF pages.
#include <cctype>

#include <zlib.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/render/lettering.h"
#include "core/render/vector_page.h"

namespace meniscus {
namespace {

/// Compresses a stream (RFC 1950) incrementally.
class Deflater {
 public:
  Deflater() {
    if (deflateInit(&stream_, Z_DEFAULT_COMPRESSION) != Z_OK)
      throw CapacityError("not enough memory to compress a page");
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  std::string add(std::span<const std::uint8_t> bytes, bool is_last = false) {
    std::string result;
    std::array<char, 1 << 15> room;
    stream_.next_in = const_cast<std::uint8_t*>(bytes.data());
    stream_.avail_in = static_cast<uInt>(bytes.size());
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(room.data());
      stream_.avail_out = static_cast<uInt>(room.size());
      deflate(&stream_, is_last ? Z_FINISH : Z_NO_FLUSH);
      result.append(room.data(), room.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
    return result;
  }
  std::string finish() { return add({}, true); }

 private:
  z_stream stream_{};
};

/// Portable Document Format 1.6 (Adobe 2004) with a single page.
class PdfEncoder : public PageEncoder {
 public:
  PdfEncoder(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings)
      : PageEncoder(path, layout, settings) {
    write("%PDF-1.6\n%\xc2\xb5\xc2\xb6\n");
    if (!has_pixels()) return;
    begin(kImage);
    write(image_dictionary("/DeviceRGB", fmt::format("{} 0 R", int{kImageLength})) +
          (channels() == 4 ? fmt::format(" /SMask {} 0 R", int{kMask}) : "") + " >>\nstream\n");
    image_begin_ = offset_;
  }

 private:
  enum : int { kPages = 1, kImage, kImageLength, kMask, kEnd };  ///< objects whose numbers others need before

  /// A font of the page and its letters there.
  struct EmbeddedFont {
    std::shared_ptr<const FontProgram> program;
    std::map<std::uint32_t, PlacedLetter> letters;  ///< key: number of the letter in the font
  };
  /// Names of the resources of the page, in the order of their numbers.
  struct Resources {
    std::vector<std::string> opacities, layers;
    std::vector<EmbeddedFont> fonts;
  };

  void write(std::string_view text) {
    output_.write(text);
    offset_ += text.size();
  }
  void begin(int object) {
    offsets_[object] = offset_;
    write(fmt::format("{} 0 obj\n", object));
  }
  void object(int object, const std::string& text) {
    begin(object);
    write(text + "\nendobj\n");
  }
  /// Writes an object, and returns its number.
  int object(const std::string& text) {
    offsets_.push_back(0);
    const int number = static_cast<int>(offsets_.size()) - 1;
    object(number, text);
    return number;
  }
  static std::string stream(const std::string& dictionary, const std::string& compressed) {
    return fmt::format("{} /Filter /FlateDecode /Length {} >>\nstream\n{}\nendstream", dictionary, compressed.size(),
                       compressed);
  }
  static std::string compressed(const std::string& bytes) {
    Deflater deflater;
    std::string result = deflater.add({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    return result + deflater.finish();
  }

  std::string image_dictionary(const char* colors, const std::string& length) const {
    const std::string plain =
        fmt::format("<< /Type /XObject /Subtype /Image /Width {} /Height {} /ColorSpace {} /BitsPerComponent 8",
                    layout_.picture_size.x, layout_.picture_size.y, colors);
    return length.empty() ? plain : plain + " /Filter /FlateDecode /Length " + length;
  }

  void add_pixels(const std::vector<std::uint8_t>& pixels) override {
    if (channels() == 3) return write(pixels_.add(pixels));
    std::vector<std::uint8_t> colors, alphas;
    for (std::size_t n = 0; n + 3 < pixels.size(); n += 4) {
      colors.insert(colors.end(), &pixels[n], &pixels[n] + 3);
      alphas.push_back(pixels[n + 3]);
    }
    write(pixels_.add(colors));
    mask_ += alphas_.add(alphas);
  }

  void finish(std::span<const PageShape> shapes) override {
    if (has_pixels()) {
      write(pixels_.finish());
      const std::size_t length = offset_ - image_begin_;
      write("\nendstream\nendobj\n");
      object(kImageLength, fmt::format("{}", length));
    }
    if (has_pixels() && channels() == 4) {
      mask_ += alphas_.finish();
      object(kMask, stream(image_dictionary("/DeviceGray", ""), mask_));
    }
    Resources used;
    const int drawn = object(stream("<<", compressed(contents(shapes, used))));
    const glm::dvec2 page = size() * points();
    std::string states, fonts, layers, layer_list;
    for (std::size_t n = 0; n < used.opacities.size(); ++n)
      states += fmt::format(" /O{} << /ca {} /CA {} >>", n, used.opacities[n], used.opacities[n]);
    for (std::size_t n = 0; n < used.fonts.size(); ++n)
      fonts += fmt::format(" /F{} {} 0 R", n, write_font(used.fonts[n]));
    for (std::size_t n = 0; n < used.layers.size(); ++n) {
      const int layer = object("<< /Type /OCG /Name " + hex_text(used.layers[n]) + " >>");
      layers += fmt::format(" /L{} {} 0 R", n, layer);
      layer_list += fmt::format(" {} 0 R", layer);
    }
    const int only =
        object(fmt::format("<< /Type /Page /Parent {} 0 R /MediaBox [0 0 {} {}] /Contents {} 0 R /Group << /S "
                           "/Transparency /CS /DeviceRGB "
                           ">> /Resources << /ExtGState <<{} >> /Font <<{} >> /Properties <<{} >>{} >> >>",
                           int{kPages}, number(page.x), number(page.y), drawn, states, fonts, layers,
                           has_pixels() ? fmt::format(" /XObject << /Molecule {} 0 R >>", int{kImage}) : ""));
    object(kPages, fmt::format("<< /Type /Pages /Kids [{} 0 R] /Count 1 >>", only));
    const int catalog = object(fmt::format(
        "<< /Type /Catalog /Pages {} 0 R /OCProperties << /OCGs [{} ] /D << /ON [{} ] /Order [{} ] >> >> >>",
        int{kPages}, layer_list, layer_list, layer_list));
    std::string info;
    if (settings_.names_program) info += " /Producer (Meniscus " MENISCUS_VERSION ")";
    if (!settings_.command.empty()) info += " /Subject " + hex_text(settings_.command);
    if (!settings_.scene.empty()) info += " /MeniscusScene " + hex_text(settings_.scene);
    write_ends(catalog, object("<<" + info + " >>"));
  }

  /// Writes a font with all of its letters (PDF Reference 1.6, 5.6: Type 0, by the numbers of its letters). Returns
  /// the number of its object.
  int write_font(const EmbeddedFont& font) {
    const FontProgram& program = *font.program;
    if (!program.may_be_embedded)
      throw RequestError(
          message("{}: the licence of this font forbids to embed it in a PDF file; choose another @font@",
                  in_quotes(program.file)));
    std::string name = program.postscript_name;
    std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-'; });
    const std::string bytes = font_bytes(program.file);
    const int file = object(stream(
        program.is_cff ? "<< /Subtype /OpenType" : fmt::format("<< /Length1 {}", bytes.size()), compressed(bytes)));
    const auto& [left, bottom, right, top] = program.box;
    const int descriptor =
        object(fmt::format("<< /Type /FontDescriptor /FontName /{} /Flags 4 /FontBBox [{} {} {} {}] /ItalicAngle 0 "
                           "/Ascent {} /Descent {} "
                           "/CapHeight {} /StemV 80 /FontFile{} {} 0 R >>",
                           name, left, bottom, right, top, program.ascent, program.descent, program.capital_height,
                           program.is_cff ? 3 : 2, file));
    std::string widths, meanings;
    for (const auto& [glyph, letter] : font.letters) {
      widths += fmt::format(" {} [{}]", glyph, number(letter.advance));
      meanings += fmt::format("1 beginbfchar <{:04X}> <{}> endbfchar\n", glyph, utf16_digits(letter.code));
    }
    const int letters = object(fmt::format(
        "<< /Type /Font /Subtype /CIDFontType{} /BaseFont /{} /CIDSystemInfo << /Registry (Adobe) /Ordering (Identity) "
        "/Supplement 0 >> /FontDescriptor {} 0 R /W [{} ]{} >>",
        program.is_cff ? 0 : 2, name, descriptor, widths, program.is_cff ? "" : " /CIDToGIDMap /Identity"));
    const int texts =
        object(stream("<<", compressed("/CIDInit /ProcSet findresource begin 12 dict begin begincmap\n"
                                       "/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) "
                                       "/Supplement 0 >> def\n"
                                       "/CMapName /Adobe-Identity-UCS def /CMapType 2 def\n"
                                       "1 begincodespacerange <0000> <FFFF> endcodespacerange\n" +
                                       meanings + "endcmap CMapName currentdict /CMap defineresource pop end end\n")));
    return object(
        fmt::format("<< /Type /Font /Subtype /Type0 /BaseFont /{} /Encoding /Identity-H /DescendantFonts "
                    "[{} 0 R] /ToUnicode {} 0 R >>",
                    name, letters, texts));
  }

  /// Returns a character in UTF-16 as hexadecimal digits.
  static std::string utf16_digits(char32_t code) {
    const auto number = static_cast<std::uint32_t>(code);
    if (number < 0x10000) return fmt::format("{:04X}", number);
    return fmt::format("{:04X}{:04X}", 0xd800 + ((number - 0x10000) >> 10), 0xdc00 + ((number - 0x10000) & 0x3ff));
  }

  void write_ends(int catalog, int info) {
    const std::size_t table = offset_, end = offsets_.size();
    write(fmt::format("xref\n0 {}\n0000000000 65535 f \n", end));
    for (std::size_t n = 1; n < end; ++n)
      write(offsets_[n] > 0 ? fmt::format("{:010} 00000 n \n", offsets_[n]) : std::string("0000000000 65535 f \n"));
    write(fmt::format("trailer\n<< /Size {} /Root {} 0 R /Info {} 0 R >>\nstartxref\n{}\n%%EOF\n", end, catalog, info,
                      table));
  }

  double points() const { return 72.0 * pixel(); }

  /// Returns the bytes of a text, UTF-8, as hexadecimal digits.
  static std::string hex_text(std::string_view text) {
    std::string digits = "<EFBBBF";
    for (const char c : text) digits += fmt::format("{:02X}", static_cast<unsigned char>(c));
    return digits + ">";
  }

  static std::string point(const glm::dvec2& place) { return number(place.x) + " " + number(place.y); }

  static std::string color(const glm::vec3& color, const char* what) {
    return fmt::format("{} {} {} {}\n", number(color.x), number(color.y), number(color.z), what);
  }

  /// Returns the place of a value in a list, to which it is added if it is new.
  static std::size_t place_in(std::vector<std::string>& list, const std::string& value) {
    const auto known = std::ranges::find(list, value);
    const auto place = static_cast<std::size_t>(known - list.begin());
    if (known == list.end()) list.push_back(value);
    return place;
  }

  /// Returns a part of the contents as a layer.
  static std::string in_layer(const std::string& name, const std::string& part, Resources& used) {
    return fmt::format("/OC /L{} BDC\n{}EMC\n", place_in(used.layers, name), part);
  }

  static std::string contents_of(const PageText& text, bool has_halo, Resources& used) {
    // Letters are upright although rows are counted downwards.
    std::string result = fmt::format("BT {} Tr 1 0 0 -1 {} Tm", has_halo ? 2 : 0, point(text.start));
    std::size_t open = used.fonts.size();
    double expected = 0.0;
    bool is_open = false;
    for (const PlacedLetter& letter : text.letters) {
      const auto has_it = [&](const EmbeddedFont& font) { return font.program->file == letter.font->file; };
      const auto known = std::ranges::find_if(used.fonts, has_it);
      const auto place = static_cast<std::size_t>(known - used.fonts.begin());
      if (known == used.fonts.end()) used.fonts.push_back({letter.font, {}});
      used.fonts[place].letters.try_emplace(letter.glyph, letter);
      if (!is_open || place != open)
        result += fmt::format("{} /F{} {} Tf [", is_open ? "] TJ" : "", place, text.height);
      const double move = 1000.0 * (expected - letter.x) / text.height;
      if (std::abs(move) >= 0.5) result += number(move);
      result += fmt::format("<{:04X}>", letter.glyph);
      expected = letter.x + letter.advance * text.height / 1000.0;
      open = place;
      is_open = true;
    }
    return result + (is_open ? "] TJ ET\n" : " ET\n");
  }

  std::string contents(std::span<const PageShape> shapes, Resources& used) const {
    // From here on coordinates are pixels of the picture, from its top left.
    std::string text = fmt::format("{} 0 0 {} {} {} cm 1 J 1 j\n", scale(), "-" + scale(),
                                   number(-layout_.low.x * points()), number(layout_.high.y * points()));
    if (settings_.background)
      text +=
          in_layer("background",
                   color(*settings_.background, "rg") + fmt::format("{} {} {} {} re f\n", layout_.low.x, layout_.low.y,
                                                                    number(size().x), number(size().y)),
                   used);
    const glm::ivec2 place = layout_.picture_place, picture = layout_.picture_size;
    if (has_pixels())
      text += in_layer(
          "molecule",
          fmt::format("q {} 0 0 {} {} {} cm /Molecule Do Q\n", picture.x, -picture.y, place.x, place.y + picture.y),
          used);
    for_each_group(shapes, [&](const std::string& group, std::span<const PageShape> of_group) {
      std::string part;
      for (const PageShape& shape : of_group) part += contents_of(shape, used);
      // Programs that copy text take each word once.
      if (group.ends_with(kHalos)) part = "/Span << /ActualText () >> BDC\n" + part + "EMC\n";
      text += in_layer(group, part, used);
    });
    return text;
  }

  static std::string contents_of(const PageShape& shape, Resources& used) {
    const bool has_line = shape.line > 0.0;
    std::string text = fmt::format("/O{} gs ", place_in(used.opacities, number(shape.opacity)));
    if (!has_line || shape.text) text += color(shape.color, "rg");
    if (has_line) text += color(shape.color, "RG") + number(shape.line) + " w\n";
    if (shape.text) return text + contents_of(*shape.text, has_line, used);
    const glm::dvec2 extent = shape.to - shape.from;
    return text + point(shape.from) + (has_line ? " m " + point(shape.to) + " l S\n" : " " + point(extent) + " re f\n");
  }

  /// Returns the scale with more decimals than coordinates have.
  std::string scale() const { return fmt::format("{:.9f}", points()); }

  std::vector<std::size_t> offsets_ = std::vector<std::size_t>(kEnd);  ///< one per number of an object; 0: not written
  std::size_t offset_ = 0, image_begin_ = 0;
  Deflater pixels_, alphas_;
  std::string mask_;
};

}  // namespace

std::unique_ptr<PageEncoder> pdf_encoder(const std::filesystem::path& path, const PageLayout& layout,
                                         const ImageSettings& settings) {
  return std::make_unique<PdfEncoder>(path, layout, settings);
}

}  // namespace meniscus
