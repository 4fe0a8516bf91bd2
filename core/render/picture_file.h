// SPDX-License-Identifier: BSD-3-Clause
// Writes a picture with annotations and legend to its file, some rows at a time.
#pragma once

#include "core/render/annotation.h"
#include "core/render/picture.h"
#include "core/render/image_output.h"
#include "core/render/legend.h"
#include "core/render/vector_page.h"

namespace meniscus {

struct Camera;

/// The content of a picture in addition to the molecule. The annotations and the legend must outlive the file.
/// PlaceLabel::is_hidden is read when the first band comes.
struct PictureMargins {
  const Annotations& annotations;
  const std::optional<Legend>& legend;
  Strips strips{};
};

/// Takes the bands of a picture of the molecule (RenderSettings::take_band), so that it is never in memory as a whole.
/// On a page (is_page()) only the molecule is in pixels.
class PictureFile {
 public:
  /// Opens the file and sets settings.take_band, so that the bands of the molecule's picture go to it. This object must
  /// therefore outlive the drawing with these settings. Throws OutputError if the file cannot be written, and
  /// RequestError if a title or label does not fit.
  PictureFile(const std::filesystem::path& path, const PictureMargins& margins, const Camera& camera,
              const ImageSettings& image, RenderSettings& settings);
  PictureFile(const PictureFile&) = delete;
  PictureFile& operator=(const PictureFile&) = delete;

  /// True if a ray has hit anything in the bands so far.
  bool shows_something() const { return shows_something_; }

  /// True if labels that need not fit were left out because there is no room.
  bool lacks_labels() const { return annotations_.lacks_labels(); }

  /// Completes the file after the last band of the molecule's picture.
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
  std::unique_ptr<ImageWriter> writer_;  // exactly one of the two exists
  std::unique_ptr<PageFile> page_;
  bool shows_something_ = false;
};

/// Writes a legend as a file of its own. Throws OutputError.
void write_legend_picture(const std::filesystem::path& path, const Legend& legend, const ImageSettings& settings);

}  // namespace meniscus
