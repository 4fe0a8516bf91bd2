// SPDX-License-Identifier: BSD-3-Clause
// A picture on its way from a renderer to its file: with annotations and legend, some rows at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "core/render/annotation.h"
#include "core/render/picture.h"
#include "core/render/image_output.h"
#include "core/render/legend.h"
#include "core/render/vector_page.h"

namespace meniscus {

struct Camera;

/// What a picture shows beside the molecule; the first two must stay. Which labels are hidden is read with the first
/// band.
struct PictureMargins {
  const Annotations& annotations;
  const std::optional<Legend>& legend;
  Strips strips{};
};

/// Takes the bands of a picture of the molecule (RenderSettings::take_band), so that it is never in memory as a whole.
/// Of a page (is_page()) the molecule alone is in pixels.
class PictureFile {
 public:
  /// settings: of the molecule's picture, whose bands come here from now on. Throws as ImageWriter and
  /// annotate() do.
  PictureFile(const std::filesystem::path& path, const PictureMargins& margins, const Camera& camera,
              const ImageSettings& image, RenderSettings& settings);
  PictureFile(const PictureFile&) = delete;
  PictureFile& operator=(const PictureFile&) = delete;

  /// Did a ray meet anything in what came?
  bool shows_something() const { return shows_something_; }

  /// Labels that need not fit have no room in it.
  bool lacks_labels() const { return annotations_.lacks_labels(); }

  /// Once all of the molecule's picture is there.
  void commit();

 private:
  ImageSettings seen_by(const Camera& camera, ImageSettings image) const;
  void take(const Framebuffer& band, int first_row);
  void write_strip(int first_row, int count);
  void write_molecule(Framebuffer rows, int first_row);
  void write(Framebuffer rows, int first_row, int count);

  const PictureMargins margins_;
  const std::optional<glm::vec3> background_;
  const PictureLayers layers_;
  const glm::ivec2 molecule_size_, size_;
  AnnotationLayer annotations_;
  std::unique_ptr<ImageWriter> writer_;  // one of the two
  std::unique_ptr<PageFile> page_;
  bool shows_something_ = false;
};

/// A legend as a file of its own. Throws as ImageWriter does.
void write_legend_picture(const std::filesystem::path& path, const Legend& legend, const ImageSettings& settings);

}  // namespace meniscus
