// SPDX-License-Identifier: BSD-3-Clause
// Pictures as pages, SVG and PDF: the molecule in pixels, and over it bars and lines as paths, and letters as text.
#pragma once

#include "core/base/output_file.h"
#include "core/render/annotation.h"
#include "core/render/image_output.h"
#include "core/render/legend.h"
#include "core/render/lettering.h"

namespace meniscus {

/// The end of the names of groups that hold the rims of letters and lines.
inline constexpr std::string_view kHalos = "halos";

/// A text of a page.
struct PageText {
  std::string text;
  int height = 0;         ///< height of a line's letters, pixels
  glm::dvec2 start{0.0};  ///< start of the baseline, in pixels from the top left
  std::vector<PlacedLetter> letters;
};

/// A line with round ends, a filled box, or a text, in pixels of the picture.
struct PageShape {
  std::string group;  ///< name of the group to which it belongs; groups are in the order of their first shapes
  glm::vec3 color;    ///< sRGB
  glm::dvec2 from{0.0}, to{0.0};  ///< ends of the line, which is a dot if they are equal; or low and high of the box
  std::optional<PageText> text{};
  double line = 0.0;  ///< width of the line, or of a stroke around letters; 0: a box, or plain letters
  double opacity = 1.0;
};

/// The arrangement of a page, in pixels of the picture.
struct PageLayout {
  glm::ivec2 low{0}, high{0};                    ///< borders of the page
  glm::ivec2 picture_place{0}, picture_size{0};  ///< place and size of the picture's pixels; 0: there are none
};

/// The common part of both kinds of pages: the properties of a page, and its file.
class PageEncoder {
 public:
  PageEncoder(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings)
      : layout_(layout), settings_(settings), output_(path, settings.existing) {}
  virtual ~PageEncoder() = default;

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
  double pixel() const {
    constexpr double kPixelsPerInch = 96.0;  // the default, as in CSS
    return 1.0 / (settings_.dots_per_inch > 0.0 ? settings_.dots_per_inch : kPixelsPerInch);
  }

  /// Returns a number with at most three decimals.
  static std::string number(double value) {
    std::string text = fmt::format("{:.3f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? "0" : text;
  }
  /// Returns a colour as "#rrggbb".
  static std::string hex(const glm::vec3& color) {
    const auto byte_of = [](float value) { return static_cast<int>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte_of(color.x), byte_of(color.y), byte_of(color.z));
  }

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

/// Return the writer of a page of this format, whose file is open. Throws OutputError.
std::unique_ptr<PageEncoder> svg_encoder(const std::filesystem::path& path, const PageLayout& layout,
                                         const ImageSettings& settings);
std::unique_ptr<PageEncoder> pdf_encoder(const std::filesystem::path& path, const PageLayout& layout,
                                         const ImageSettings& settings);

/// True if the extension names a page (.svg, .pdf).
bool is_page(const std::filesystem::path& path);

/// Returns the shapes of the annotations in these rows of the picture. The first group, "halos", has the rims of
/// everything that extends into the rows.
std::vector<PageShape> shapes_of(const AnnotationLayer& annotations, int first_row, int end_row);
std::vector<PageShape> shapes_of(const Legend& legend, const std::optional<glm::vec3>& background);

/// A page that is written as the rows of its pixels come. It gets its final name at the end. A pixel is 1/96 inch
/// unless the settings give a resolution. The page is transparent unless there is a background. Its pixels are in the
/// group "molecule". In PDF, groups are layers, and fonts are embedded as a whole, so that texts can be changed.
class PageFile {
 public:
  /// Opens the page. Throws OutputError.
  PageFile(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings);
  ~PageFile();

  /// Adds the next rows of pixels, as a picture of their own.
  void add(const Framebuffer& rows);
  /// Completes the page after the last row. Throws RequestError if it needs a font that must not be embedded.
  void commit(std::span<const PageShape> shapes);

 private:
  std::unique_ptr<PageEncoder> encoder_;
};

}  // namespace meniscus
