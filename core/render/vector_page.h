// SPDX-License-Identifier: BSD-3-Clause
// Pictures as pages, SVG and PDF: the molecule in pixels, and over it bars and lines as paths, and letters as text.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/render/annotation.h"
#include "core/render/image_output.h"
#include "core/render/legend.h"
#include "core/render/page_encoder.h"

namespace meniscus {

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
