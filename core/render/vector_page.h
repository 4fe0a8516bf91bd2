// SPDX-License-Identifier: BSD-3-Clause
// Pictures as pages, SVG and PDF: the molecule in pixels, and over it bars and lines as paths, and letters as text.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/render/annotation.h"
#include "core/render/image_output.h"
#include "core/render/legend.h"
#include "core/render/lettering.h"

namespace meniscus {

/// True if the extension names a page (.svg, .pdf).
bool is_page(const std::filesystem::path& path);

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

/// Returns the shapes of the annotations in these rows of the picture. The first group, "halos", has the rims of
/// everything that extends into the rows.
std::vector<PageShape> shapes_of(const AnnotationLayer& annotations, int first_row, int end_row);
std::vector<PageShape> shapes_of(const Legend& legend, const std::optional<glm::vec3>& background);

/// The arrangement of a page, in pixels of the picture.
struct PageLayout {
  glm::ivec2 low{0}, high{0};                    ///< borders of the page
  glm::ivec2 picture_place{0}, picture_size{0};  ///< of the picture's pixels; 0: there are none
};

class PageEncoder;

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
