// SPDX-License-Identifier: BSD-3-Clause
// Pictures as pages, SVG and PDF: the molecule in pixels, and letters, bars and lines over it as paths.
#pragma once

#include <filesystem>
#include <memory>
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

/// A filled or stroked path, in pixels of the picture.
struct PageShape {
  std::vector<PathStep> path;
  glm::vec3 color;  ///< sRGB
  double opacity = 1.0;
  double line = 0.0;   ///< width of the stroke, with round ends and corners; 0: the path is filled
  std::string text{};  ///< the text that it shows
};

/// Returns the shapes of the annotations in these rows of the picture, including the rims of everything that extends
/// into them.
std::vector<PageShape> shapes_of(const AnnotationLayer& annotations, int first_row, int end_row);
std::vector<PageShape> shapes_of(const Legend& legend, const std::optional<glm::vec3>& background);

/// The arrangement of a page, in pixels of the picture.
struct PageLayout {
  glm::ivec2 low{0}, high{0};                    ///< borders of the page
  glm::ivec2 picture_place{0}, picture_size{0};  ///< of the picture's pixels; 0: there are none
};

/// A page that is written as the rows of its pixels come. It gets its final name at the end. A pixel is 1/96 inch
/// unless the settings give a resolution. The page is transparent unless there is a background.
class PageFile {
 public:
  /// Opens the page. Throws OutputError.
  PageFile(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings);
  ~PageFile();

  /// Adds the next rows of pixels, as a picture of their own.
  void add(const Framebuffer& rows);
  /// Completes the page after the last row.
  void commit(std::span<const PageShape> shapes);

 private:
  class Encoder;
  class SvgEncoder;
  class PdfEncoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace meniscus
