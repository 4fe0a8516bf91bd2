// SPDX-License-Identifier: BSD-3-Clause
// Pictures as pages, SVG and PDF: the molecule in pixels, and over it letters, bars and lines as paths.
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

/// A filled path, or its line. In pixels of the picture.
struct PageShape {
  std::vector<PathStep> path;
  glm::vec3 color;  ///< sRGB
  double opacity = 1.0;
  double line = 0.0;   ///< its width, with round ends and corners; 0: filled
  std::string text{};  ///< that it shows
};

/// What is written over a molecule in these rows of the picture. Its rim is around everything that reaches into them.
std::vector<PageShape> shapes_of(const AnnotationLayer& annotations, int first_row, int end_row);
std::vector<PageShape> shapes_of(const Legend& legend, const std::optional<glm::vec3>& background);

/// Where things are on a page, in pixels of the picture.
struct PageLayout {
  glm::ivec2 low{0}, high{0};                    ///< of the page
  glm::ivec2 picture_place{0}, picture_size{0};  ///< of its pixels; 0: there are none
};

/// A page that is written as the rows of its pixels come; nothing is under its name before the end. A pixel is a
/// 96th of an inch unless the settings say how many there are. Transparent unless there is a background.
class PageFile {
 public:
  /// Throws OutputError.
  PageFile(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings);
  ~PageFile();

  /// The next rows of pixels, as a picture of their own.
  void add(const Framebuffer& rows);
  /// Behind the last row.
  void commit(std::span<const PageShape> shapes);

 private:
  class Encoder;
  class SvgEncoder;
  class PdfEncoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace meniscus
