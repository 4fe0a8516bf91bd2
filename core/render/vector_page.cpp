// SPDX-License-Identifier: BSD-3-Clause
// Writes pages, SVG and PDF: the pixels of a picture, and everything that is written over it as paths.
#include "core/render/vector_page.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <zlib.h>

#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/image/png_file.h"

namespace meniscus {
namespace {

using Kind = PathStep::Kind;

std::vector<PathStep> box_path(const glm::dvec2& low, const glm::dvec2& high) {
  return {{Kind::move, {low}},
          {Kind::line, {glm::dvec2(high.x, low.y)}},
          {Kind::line, {high}},
          {Kind::line, {glm::dvec2(low.x, high.y)}},
          {Kind::close}};
}

std::vector<PathStep> line_path(const glm::dvec2& from, const glm::dvec2& to) {
  return {{Kind::move, {from}}, {Kind::line, {to}}};
}

/// Returns a circle of four cubic curves, accurate to 0.03 % of its radius.
std::vector<PathStep> circle_path(const glm::dvec2& middle, double radius) {
  const double handle = 0.5522847498 * radius;
  std::vector<PathStep> path{{Kind::move, {middle + glm::dvec2(radius, 0.0)}}};
  glm::dvec2 from(1.0, 0.0);
  for (int n = 0; n < 4; ++n) {
    const glm::dvec2 to(-from.y, from.x);
    path.push_back(
        {Kind::curve,
         {middle + radius * from + handle * to, middle + radius * to + handle * from, middle + radius * to}});
    from = to;
  }
  path.push_back({Kind::close});
  return path;
}

/// Returns the shapes of a stroke that is wider by `around` on all sides.
std::vector<PageShape> shapes_of(const InkStroke& stroke, const glm::vec3& color, double around, FontShelf& fonts) {
  std::vector<PageShape> shapes;
  if (const auto* const text = std::get_if<InkText>(&stroke)) {
    PageShape shape{fonts.of(*text).outline(text->text, text->place), color};
    if (around == 0.0) shape.text = text->text;
    shapes.push_back(shape);
    if (around > 0.0) shape.line = 2.0 * around, shapes.push_back(shape);
  } else if (const auto* const line = std::get_if<InkLine>(&stroke)) {
    const double width = line->width + 2.0 * around;
    if (line->from == line->to)
      shapes.push_back({circle_path(line->from, 0.5 * width), color, line->share});
    else
      shapes.push_back({line_path(line->from, line->to), color, line->share, width});
  } else if (const auto* const box = std::get_if<PixelBox>(&stroke)) {
    shapes.push_back({box_path(glm::dvec2(box->low) - around, glm::dvec2(box->high) + around), color});
  }
  return shapes;
}

bool reaches_into(const InkStroke& stroke, int first_row, int end_row) {
  double low = 0.0, high = 0.0;
  if (const auto* const text = std::get_if<InkText>(&stroke)) {
    low = text->place.y - text->height;
    high = text->place.y + text->height;
  } else if (const auto* const line = std::get_if<InkLine>(&stroke)) {
    low = std::min(line->from.y, line->to.y) - line->width;
    high = std::max(line->from.y, line->to.y) + line->width;
  } else if (const auto* const box = std::get_if<PixelBox>(&stroke)) {
    low = box->low.y;
    high = box->high.y;
  }
  return low < end_row && high > first_row;
}

void append(std::vector<PageShape>& shapes, std::vector<PageShape> more) {
  shapes.insert(shapes.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

std::vector<PageShape> shapes_of(const AnnotationLayer& annotations, int first_row, int end_row) {
  FontShelf fonts;
  std::vector<PageShape> shapes;
  const Inks& inks = annotations.inks();
  for (const InkStroke& stroke : annotations.strokes())
    if (reaches_into(stroke, first_row, end_row))
      append(shapes, shapes_of(stroke, inks.rim, annotations.rim_width(), fonts));
  for (const InkStroke& stroke : annotations.strokes()) append(shapes, shapes_of(stroke, inks.ink, 0.0, fonts));
  return shapes;
}

std::vector<PageShape> shapes_of(const Legend& legend, const std::optional<glm::vec3>& background) {
  std::vector<PageShape> shapes;
  const glm::vec3 ink = legend.inks(background).ink;
  for (const LegendBox& box : legend.boxes()) {
    if (box.colors.front().x < 0.0f) continue;  // "+3 more" has no colour
    const glm::dvec2 low(box.low), high(box.high), frame(legend.frame_width());
    shapes.push_back({box_path(low - frame, high + frame), ink});
    const bool upright = high.y - low.y > high.x - low.x;
    // Each colour extends to the end of the bar, so that no paper is visible between two colours.
    for (std::size_t n = 0; n < box.colors.size(); ++n) {
      if (n > 0 && box.colors[n] == box.colors[n - 1]) continue;
      const double along = static_cast<double>(n);
      shapes.push_back(
          {upright ? box_path(low, {high.x, high.y - along}) : box_path({low.x + along, low.y}, high), box.colors[n]});
    }
  }
  for (const LegendText& text : legend.texts()) {
    PageShape shape{legend.font().outline(text.text, text.place), ink};
    shape.text = text.text;
    shapes.push_back(std::move(shape));
  }
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
    output_.write(fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" version=\"1.1\" "
        "width=\"{}\" height=\"{}\" viewBox=\"{} {} {} {}\">\n",
        length(page.x), length(page.y), layout_.low.x, layout_.low.y, page.x, page.y));
    if (settings_.names_program) output_.write("<!-- Meniscus " MENISCUS_VERSION " -->\n");
    if (!settings_.command.empty()) output_.write("<desc>" + markup_text(settings_.command) + "</desc>\n");
    if (!settings_.scene.empty())
      output_.write("<metadata><scene xmlns=\"urn:meniscus:scene\">" + markup_text(settings_.scene) +
                    "</scene></metadata>\n");
    if (settings_.background)
      output_.write(fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", layout_.low.x,
                                layout_.low.y, page.x, page.y, hex(*settings_.background)));
  }

  void add_pixels(const std::vector<std::uint8_t>& pixels) override { png_->add(pixels, channels()); }

  void finish(std::span<const PageShape> shapes) override {
    if (png_) {
      png_->finish();
      output_.write(base64(waiting_) + "\"/>\n");
    }
    for (const PageShape& shape : shapes) output_.write(element(shape));
    output_.write("</svg>\n");
  }

  static std::string element(const PageShape& shape) {
    std::string path;
    for (const PathStep& step : shape.path) {
      const auto& [a, b, c] = step.points;
      switch (step.kind) {
        case PathStep::Kind::move:
          path += "M" + point(a);
          break;
        case PathStep::Kind::line:
          path += "L" + point(a);
          break;
        case PathStep::Kind::curve:
          path += "C" + point(a) + " " + point(b) + " " + point(c);
          break;
        case PathStep::Kind::close:
          path += "Z";
      }
    }
    if (path.empty()) return {};  // blanks
    const std::string opacity = shape.opacity < 1.0 ? fmt::format(" opacity=\"{}\"", number(shape.opacity)) : "";
    const std::string name = shape.text.empty() ? "" : fmt::format(" aria-label=\"{}\"", markup_text(shape.text));
    if (shape.line == 0.0)
      return fmt::format("<path{}{} fill=\"{}\" d=\"{}\"/>\n", name, opacity, hex(shape.color), path);
    return fmt::format(
        "<path{} fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\" "
        "stroke-linejoin=\"round\" d=\"{}\"/>\n",
        opacity, hex(shape.color), number(shape.line), path);
  }

  std::string waiting_;  ///< bytes of the picture that do not make four letters yet
  std::optional<PngEncoder> png_;
};

/// Portable Document Format 1.4 (Adobe 2001) with a single page.
class PageFile::PdfEncoder : public Encoder {
 public:
  PdfEncoder(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings)
      : Encoder(path, layout, settings) {
    write("%PDF-1.4\n%\xc2\xb5\xc2\xb6\n");
    if (!has_pixels()) return;
    begin(kImage);
    write(image_dictionary("/DeviceRGB", fmt::format("{} 0 R", int{kImageLength})) +
          (channels() == 4 ? fmt::format(" /SMask {} 0 R", int{kMask}) : "") + " >>\nstream\n");
    image_begin_ = offset_;
  }

 private:
  enum Object : int { kCatalog = 1, kPages, kPage, kContents, kInfo, kImage, kImageLength, kMask, kEnd };

  void write(std::string_view text) {
    output_.write(text);
    offset_ += text.size();
  }
  void begin(Object object) {
    offsets_[object] = offset_;
    write(fmt::format("{} 0 obj\n", int{object}));
  }
  void object(Object object, const std::string& text) {
    begin(object);
    write(text + "\nendobj\n");
  }
  void stream(Object object, const std::string& dictionary, const std::string& bytes) {
    begin(object);
    write(fmt::format("{} /Filter /FlateDecode /Length {} >>\nstream\n", dictionary, bytes.size()));
    write(bytes);
    write("\nendstream\nendobj\n");
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
      stream(kMask, image_dictionary("/DeviceGray", ""), mask_);
    }
    std::vector<std::string> opacities;
    const std::string drawn = contents(shapes, opacities);
    Deflater deflater;
    std::string compressed = deflater.add({reinterpret_cast<const std::uint8_t*>(drawn.data()), drawn.size()});
    compressed += deflater.finish();
    stream(kContents, "<<", compressed);
    const glm::dvec2 page = size() * points();
    std::string states;
    for (std::size_t n = 0; n < opacities.size(); ++n)
      states += fmt::format(" /O{} << /ca {} /CA {} >>", n, opacities[n], opacities[n]);
    object(kPage, fmt::format("<< /Type /Page /Parent {} 0 R /MediaBox [0 0 {} {}] /Contents {} 0 R /Group << /S "
                              "/Transparency /CS /DeviceRGB >> /Resources << /ExtGState <<{} >>{} >> >>",
                              int{kPages}, number(page.x), number(page.y), int{kContents}, states,
                              has_pixels() ? fmt::format(" /XObject << /Molecule {} 0 R >>", int{kImage}) : ""));
    object(kPages, fmt::format("<< /Type /Pages /Kids [{} 0 R] /Count 1 >>", int{kPage}));
    object(kCatalog, fmt::format("<< /Type /Catalog /Pages {} 0 R >>", int{kPages}));
    std::string info;
    if (settings_.names_program) info += " /Producer (Meniscus " MENISCUS_VERSION ")";
    if (!settings_.command.empty()) info += " /Subject " + hex_text(settings_.command);
    if (!settings_.scene.empty()) info += " /MeniscusScene " + hex_text(settings_.scene);
    object(kInfo, "<<" + info + " >>");
    write_ends();
  }

  void write_ends() {
    const std::size_t table = offset_;
    write(fmt::format("xref\n0 {}\n0000000000 65535 f \n", int{kEnd}));
    for (int n = 1; n < kEnd; ++n)
      write(offsets_[n] > 0 ? fmt::format("{:010} 00000 n \n", offsets_[n]) : std::string("0000000000 65535 f \n"));
    write(fmt::format("trailer\n<< /Size {} /Root {} 0 R /Info {} 0 R >>\nstartxref\n{}\n%%EOF\n", int{kEnd},
                      int{kCatalog}, int{kInfo}, table));
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

  std::string contents(std::span<const PageShape> shapes, std::vector<std::string>& opacities) const {
    // From here on coordinates are pixels of the picture, from its top left.
    std::string text = fmt::format("{} 0 0 {} {} {} cm 1 J 1 j\n", scale(), "-" + scale(),
                                   number(-layout_.low.x * points()), number(layout_.high.y * points()));
    if (settings_.background)
      text += color(*settings_.background, "rg") +
              fmt::format("{} {} {} {} re f\n", layout_.low.x, layout_.low.y, number(size().x), number(size().y));
    const glm::ivec2 place = layout_.picture_place, picture = layout_.picture_size;
    if (has_pixels())
      text += fmt::format("q {} 0 0 {} {} {} cm /Molecule Do Q\n", picture.x, -picture.y, place.x, place.y + picture.y);
    for (const PageShape& shape : shapes) {
      const std::string opacity = number(shape.opacity);
      const auto known = std::ranges::find(opacities, opacity);
      text += fmt::format("/O{} gs ", known - opacities.begin());
      if (known == opacities.end()) opacities.push_back(opacity);
      text += color(shape.color, shape.line > 0.0 ? "RG" : "rg");
      if (shape.line > 0.0) text += number(shape.line) + " w\n";
      for (const PathStep& step : shape.path) {
        const auto& [a, b, c] = step.points;
        switch (step.kind) {
          case PathStep::Kind::move:
            text += point(a) + " m\n";
            break;
          case PathStep::Kind::line:
            text += point(a) + " l\n";
            break;
          case PathStep::Kind::curve:
            text += point(a) + " " + point(b) + " " + point(c) + " c\n";
            break;
          case PathStep::Kind::close:
            text += "h\n";
        }
      }
      text += shape.line > 0.0 ? "S\n" : "f\n";
    }
    return text;
  }

  /// Returns the scale with more decimals than coordinates have.
  std::string scale() const { return fmt::format("{:.9f}", points()); }

  std::array<std::size_t, kEnd> offsets_{};
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
