// SPDX-License-Identifier: BSD-3-Clause
// Turns annotations and legends into shapes of a page, passes them to the writer of its format, and writes SVG pages.
#include "core/render/vector_page.h"

#include <cctype>

#include "core/base/system_file.h"
#include "core/base/version.h"
#include "core/image/png_file.h"

namespace meniscus {
namespace {

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
    const double half = 0.56 * text->height;  // includes accents, and parts of letters below the line
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

std::string extension_in_small_letters(const std::filesystem::path& path) {
  std::string extension = text_of_path(path.extension());
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

}  // namespace

bool is_page(const std::filesystem::path& path) {
  const std::string extension = extension_in_small_letters(path);
  return extension == ".svg" || extension == ".pdf";
}

PageFile::PageFile(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings) {
  encoder_ = (extension_in_small_letters(path) == ".svg" ? svg_encoder : pdf_encoder)(path, layout, settings);
}

PageFile::~PageFile() = default;

void PageFile::add(const Framebuffer& rows) { encoder_->add(rows); }

void PageFile::commit(std::span<const PageShape> shapes) { encoder_->commit(shapes); }

namespace {

/// Scalable Vector Graphics 1.1 (W3C 2011).
class SvgEncoder : public PageEncoder {
 public:
  SvgEncoder(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings)
      : PageEncoder(path, layout, settings) {
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

}  // namespace

std::unique_ptr<PageEncoder> svg_encoder(const std::filesystem::path& path, const PageLayout& layout,
                                         const ImageSettings& settings) {
  return std::make_unique<SvgEncoder>(path, layout, settings);
}

}  // namespace meniscus
