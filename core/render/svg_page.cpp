// SPDX-License-Identifier: BSD-3-Clause
// Writes SVG pages.
#include <optional>

#include "core/base/text.h"
#include "core/base/version.h"
#include "core/image/png_file.h"
#include "core/render/page_encoder.h"

namespace meniscus {
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
