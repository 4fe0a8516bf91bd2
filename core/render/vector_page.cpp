// SPDX-License-Identifier: BSD-3-Clause
// Writes pages, SVG and PDF: the pixels of a picture, and over it bars and lines as paths, and letters as text.
#include "core/render/vector_page.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <zlib.h>

#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/base/version.h"
#include "core/image/png_file.h"

namespace meniscus {
namespace {

constexpr std::string_view kHalos = "halos";

PageText page_text(const Font& font, const std::string& text, const glm::ivec2& place) {
  return {text, font.height(), {place.x, font.baseline(place.y)}, font.letters(text)};
}

/// Returns the shape of a stroke of the annotations that is wider by `around` on all sides.
PageShape shape_of(const InkStroke& stroke, double around, const AnnotationLayer& annotations) {
  PageShape shape;
  if (const auto* const text = std::get_if<InkText>(&stroke)) {
    shape.text = page_text(annotations.font_of(*text), text->text, text->place);
    shape.line = 2.0 * around;
  } else if (const auto* const line = std::get_if<InkLine>(&stroke)) {
    shape.from = line->from;
    shape.to = line->to;
    shape.line = line->width + 2.0 * around;
    shape.opacity = line->share;
  } else if (const auto* const box = std::get_if<PixelBox>(&stroke)) {
    shape.from = glm::dvec2(box->low) - around;
    shape.to = glm::dvec2(box->high) + around;
  }
  return shape;
}

bool reaches_into(const InkStroke& stroke, int first_row, int end_row) {
  double low = 0.0, high = 0.0;
  if (const auto* const text = std::get_if<InkText>(&stroke)) {
    const double half = 0.56 * text->height;  // with accents, or with what is below the line
    low = text->place.y - half;
    high = text->place.y + half;
  } else if (const auto* const line = std::get_if<InkLine>(&stroke)) {
    low = std::min(line->from.y, line->to.y) - line->width;
    high = std::max(line->from.y, line->to.y) + line->width;
  } else if (const auto* const box = std::get_if<PixelBox>(&stroke)) {
    low = box->low.y;
    high = box->high.y;
  }
  return low < end_row && high > first_row;
}

}  // namespace

std::vector<PageShape> shapes_of(const AnnotationLayer& annotations, int first_row, int end_row) {
  std::vector<PageShape> shapes;
  const auto add = [&](const InkStroke& stroke, double around, std::string_view group, const glm::vec3& color) {
    const auto* const text = std::get_if<InkText>(&stroke);
    if (text && text->text.empty()) return;  // the length of a hidden line
    PageShape& shape = shapes.emplace_back(shape_of(stroke, around, annotations));
    shape.group = group;
    shape.color = color;
  };
  const std::span<const InkStroke> strokes = annotations.strokes();
  const Inks& inks = annotations.inks();
  for (const InkStroke& stroke : strokes)
    if (reaches_into(stroke, first_row, end_row)) add(stroke, annotations.rim_width(), kHalos, inks.rim);
  for (std::size_t n = 0; n < strokes.size(); ++n) add(strokes[n], 0.0, annotations.group_of(n), inks.ink);
  return shapes;
}

std::vector<PageShape> shapes_of(const Legend& legend, const std::optional<glm::vec3>& background) {
  constexpr const char* kGroup = "legend";
  std::vector<PageShape> shapes;
  const glm::vec3 ink = legend.inks(background).ink;
  for (const LegendBox& box : legend.boxes()) {
    if (box.colors.front().x < 0.0f) continue;  // "+3 more" has no colour
    const glm::dvec2 low(box.low), high(box.high), frame(legend.frame_width());
    shapes.push_back({kGroup, ink, low - frame, high + frame});
    const bool upright = high.y - low.y > high.x - low.x;
    // Each colour extends to the end of the bar, so that no paper is visible between two colours.
    for (std::size_t n = 0; n < box.colors.size(); ++n) {
      if (n > 0 && box.colors[n] == box.colors[n - 1]) continue;
      const double along = static_cast<double>(n);
      shapes.push_back({kGroup, box.colors[n], upright ? low : glm::dvec2(low.x + along, low.y),
                        upright ? glm::dvec2(high.x, high.y - along) : high});
    }
  }
  for (const LegendText& text : legend.texts())
    shapes.push_back({kGroup, ink, {}, {}, page_text(legend.font(), text.text, text.place)});
  return shapes;
}

namespace {

constexpr double kPixelsPerInch = 96.0;  // the default, as in CSS

std::string extension_in_small_letters(const std::filesystem::path& path) {
  std::string extension = text_of_path(path.extension());
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// Returns a number with at most three decimals.
std::string number(double value) {
  std::string text = fmt::format("{:.3f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string point(const glm::dvec2& place) { return number(place.x) + " " + number(place.y); }

int byte_of(float value) { return static_cast<int>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

std::string hex(const glm::vec3& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", byte_of(color.x), byte_of(color.y), byte_of(color.z));
}

/// Compresses a stream (RFC 1950) incrementally.
class Deflater {
 public:
  Deflater() {
    if (deflateInit(&stream_, Z_DEFAULT_COMPRESSION) != Z_OK)
      throw CapacityError("there is no memory to compress a page");
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

}  // namespace

/// The common part of both kinds of pages.
class PageFile::Encoder {
 public:
  Encoder(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings)
      : layout_(layout), settings_(settings), output_(path, settings.existing) {}
  virtual ~Encoder() = default;

  void add(const Framebuffer& rows) { add_pixels(srgb_pixels(rows, settings_.background)); }
  void commit(std::span<const PageShape> shapes) {
    finish(shapes);
    output_.commit();
  }

 protected:
  virtual void add_pixels(const std::vector<std::uint8_t>& pixels) = 0;
  virtual void finish(std::span<const PageShape> shapes) = 0;

  bool has_pixels() const { return layout_.picture_size.x > 0 && layout_.picture_size.y > 0; }
  int channels() const { return settings_.background ? 3 : 4; }
  glm::dvec2 size() const { return layout_.high - layout_.low; }
  /// Returns the size of a pixel in inches.
  double pixel() const { return 1.0 / (settings_.dots_per_inch > 0.0 ? settings_.dots_per_inch : kPixelsPerInch); }

  /// Calls work(name, shapes) for successive shapes of one group.
  static void for_each_group(std::span<const PageShape> shapes, const auto& work) {
    while (!shapes.empty()) {
      const std::string& group = shapes.front().group;
      const auto end = std::ranges::find_if(shapes, [&](const PageShape& shape) { return shape.group != group; });
      const auto count = static_cast<std::size_t>(end - shapes.begin());
      work(group, shapes.first(count));
      shapes = shapes.subspan(count);
    }
  }

  const PageLayout layout_;
  const ImageSettings settings_;
  OutputFile output_;
};

/// Scalable Vector Graphics 1.1 (W3C 2011).
class PageFile::SvgEncoder : public Encoder {
 public:
  SvgEncoder(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings)
      : Encoder(path, layout, settings) {
    begin();
    if (!has_pixels()) return;
    ImageToEncode image;
    image.format = "png";
    image.width = layout.picture_size.x;
    image.height = layout.picture_size.y;
    image.channels = {"R", "G", "B", "A"};
    image.channels.resize(static_cast<std::size_t>(channels()));
    image.color_space = "sRGB";
    begin_group("molecule");
    output_.write(
        fmt::format("<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
                    "xlink:href=\"data:image/png;base64,",
                    layout.picture_place.x, layout.picture_place.y, image.width, image.height));
    png_.emplace(image, [this](std::span<const std::uint8_t> bytes) {
      waiting_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      const std::size_t whole = waiting_.size() / 3 * 3;
      output_.write(base64(std::string_view(waiting_).substr(0, whole)));
      waiting_.erase(0, whole);
    });
  }

 private:
  void begin() {
    const glm::dvec2 page = size();
    constexpr double kMillimetersPerInch = 25.4;
    const auto length = [&](double pixels) {
      if (settings_.dots_per_inch == 0.0) return number(pixels);
      return number(pixels * pixel() * kMillimetersPerInch) + "mm";
    };
    output_.write(
        fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                    "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
                    "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\" "
                    "width=\"{}\" height=\"{}\" viewBox=\"{} {} {} {}\">\n",
                    length(page.x), length(page.y), layout_.low.x, layout_.low.y, page.x, page.y));
    if (settings_.names_program) output_.write("<!-- Meniscus " MENISCUS_VERSION " -->\n");
    if (!settings_.command.empty()) output_.write("<desc>" + markup_text(settings_.command) + "</desc>\n");
    if (!settings_.scene.empty())
      output_.write("<metadata><scene xmlns=\"urn:meniscus:scene\">" + markup_text(settings_.scene) +
                    "</scene></metadata>\n");
    if (settings_.background)
      output_.write(fmt::format("<rect id=\"background\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n",
                                layout_.low.x, layout_.low.y, page.x, page.y, hex(*settings_.background)));
  }

  void add_pixels(const std::vector<std::uint8_t>& pixels) override { png_->add(pixels, channels()); }

  void finish(std::span<const PageShape> shapes) override {
    if (png_) {
      png_->finish();
      output_.write(base64(waiting_) + "\"/>\n</g>\n");
    }
    for_each_group(shapes, [&](const std::string& group, std::span<const PageShape> of_group) {
      begin_group(group);
      for (const PageShape& shape : of_group) output_.write(element(shape));
      output_.write("</g>\n");
    });
    output_.write("</svg>\n");
  }

  void begin_group(const std::string& name) {
    output_.write(fmt::format("<g id=\"{0}\" inkscape:groupmode=\"layer\" inkscape:label=\"{0}\"{1}>\n", name,
                              name.ends_with(kHalos) ? " aria-hidden=\"true\"" : ""));
  }

  /// Returns the names of fonts that a viewer should try. Arial is before its metric equal, which fewer systems have.
  static std::string families(const FontProgram& font) {
    if (font.family == "Liberation Sans") return "Arial, 'Liberation Sans', Helvetica, sans-serif";
    std::string family = font.family;
    std::erase_if(family, [](char c) { return c == '\'' || c == '\\'; });
    return "'" + markup_text(family) + "', Arial, Helvetica, sans-serif";
  }

  static std::string text_element(const PageText& text, const PageShape& shape) {
    if (text.letters.empty()) return {};
    const FontProgram& font = *text.letters.front().font;
    const std::string stroke = shape.line > 0.0
                                   ? fmt::format(" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
                                                 hex(shape.color), number(shape.line))
                                   : "";
    return fmt::format(
        "<text x=\"{}\" y=\"{}\" font-family=\"{}\" font-size=\"{}\"{} fill=\"{}\"{} "
        "xml:space=\"preserve\">{}</text>\n",
        number(text.start.x), number(text.start.y), families(font), text.height,
        font.is_bold ? " font-weight=\"bold\"" : "", hex(shape.color), stroke, markup_text(text.text));
  }

  static std::string element(const PageShape& shape) {
    if (shape.text) return text_element(*shape.text, shape);
    const std::string color = hex(shape.color),
                      opacity = shape.opacity < 1.0 ? fmt::format(" opacity=\"{}\"", number(shape.opacity)) : "";
    const std::string x = number(shape.from.x), y = number(shape.from.y);
    if (shape.line == 0.0)
      return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"{}/>\n", x, y,
                         number(shape.to.x - shape.from.x), number(shape.to.y - shape.from.y), color, opacity);
    if (shape.from == shape.to)
      return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"{}/>\n", x, y, number(0.5 * shape.line),
                         color, opacity);
    return fmt::format(
        "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"{}\" "
        "stroke-linecap=\"round\"{}/>\n",
        x, y, number(shape.to.x), number(shape.to.y), color, number(shape.line), opacity);
  }

  std::string waiting_;  ///< bytes of the picture that do not make four letters yet
  std::optional<PngEncoder> png_;
};

/// Portable Document Format 1.6 (Adobe 2004) with a single page.
class PageFile::PdfEncoder : public Encoder {
 public:
  PdfEncoder(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings)
      : Encoder(path, layout, settings) {
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
    std::map<std::uint32_t, PlacedLetter> letters;  ///< by their numbers in the font
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
    const std::string bytes = read_file_bytes(program.file);
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

  std::vector<std::size_t> offsets_ = std::vector<std::size_t>(kEnd);  ///< by the numbers of objects; 0: not written
  std::size_t offset_ = 0, image_begin_ = 0;
  Deflater pixels_, alphas_;
  std::string mask_;
};

bool is_page(const std::filesystem::path& path) {
  const std::string extension = extension_in_small_letters(path);
  return extension == ".svg" || extension == ".pdf";
}

PageFile::PageFile(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings) {
  if (extension_in_small_letters(path) == ".svg")
    encoder_ = std::make_unique<SvgEncoder>(path, layout, settings);
  else
    encoder_ = std::make_unique<PdfEncoder>(path, layout, settings);
}

PageFile::~PageFile() = default;

void PageFile::add(const Framebuffer& rows) { encoder_->add(rows); }

void PageFile::commit(std::span<const PageShape> shapes) { encoder_->commit(shapes); }

}  // namespace meniscus
