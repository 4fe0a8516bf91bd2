// SPDX-License-Identifier: BSD-3-Clause
// Where the pictures of `meniscus render` go: a file, numbered files, or a film.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "app/commands/render_command.h"
#include "app/film/film.h"
#include "app/options/numbered_path.h"
#include "app/reports/run_frames.h"
#include "core/camera/camera.h"
#include "core/render/annotation.h"
#include "core/scene/frame_run.h"

namespace meniscus {

/// A picture to be drawn.
struct SinkPicture {
  std::uint64_t number = 0;  ///< in the run
  std::uint64_t place = 0;   ///< in the run, from 0
  std::uint64_t source = 0;  ///< in the trajectory
  std::optional<double> time{};
  Camera camera{};
  /// The mattes that Framebuffer::seen indexes, and whether the picture has motion to the next frame. For EXR files.
  std::shared_ptr<const std::vector<Matte>> mattes{};
  bool moves = false;
};

/// What is written into the pictures of a molecule, or of a run.
class FrameAnnotations {
 public:
  /// run: whose frames they are; nullptr: there is one picture. The scene must stay. Throws InputError for its curve.
  FrameAnnotations(const Scene& scene, FrameRun* run);
  /// Throws InputError for a label of no atoms.
  Annotations of(const SinkPicture& picture, const Structure& structure) const;
  /// Before the first picture. Throws what annotate() does of what does not fit, by any of the cameras. structure: of
  /// the molecule, or in the first frame, whose labels need neither be there nor fit.
  void check(const PictureLayout& layout, std::span<const Camera> cameras, const Structure& structure) const;

 private:
  const AnnotationRequest& request_;
  bool is_run_;
  std::optional<Curve> curve_;  ///< the same in all pictures but for its mark
  double longest_ = 0.0;        ///< time of the run, ps
  std::uint64_t last_ = 0;      ///< frame of the run, in the trajectory
};

/// Where numbered pictures go; nothing where they go into a film of this format and size. Before anything is read.
/// Throws UsageError for a name that does not fit, and for a film that cannot be.
std::optional<NumberedPath> numbered_output(const std::string& path, const FilmFormat& format, glm::ivec2 size);

/// Before the first of them is made: throws OutputError if one of these pictures cannot be written.
void check_pictures(const NumberedPath& path, std::span<const std::uint64_t> numbers, Existing existing);

/// The ground of a film of such pixels: white where no background was asked for, but in a film that keeps what is
/// transparent.
std::optional<glm::vec3> ground_of_film(const std::optional<glm::vec3>& background, const FilmPixels& pixels);

class PictureSink {
 public:
  /// run: whose frames they are; nullptr: there is one picture. Throws UsageError for a name that does not fit, and for
  /// a film of a part of a run. The command, the layout and the run must stay.
  PictureSink(const RenderCommand& command, const PictureLayout& layout, FrameRun* run);

  /// Draws the molecule as the settings say: in bands where there are some to take (RenderSettings::take_band), else as
  /// a whole.
  using Draw = std::function<Framebuffer(const RenderSettings& settings)>;
  /// What is written into a picture of the structure. Throws InputError for a label of no atoms.
  Annotations annotations(const SinkPicture& picture, const Structure& structure) const {
    return annotations_.of(picture, structure);
  }
  /// FrameAnnotations::check()
  void check(std::span<const Camera> cameras, const Structure& structure) const {
    annotations_.check(layout_, cameras, structure);
  }
  /// Draws a picture, on any thread; what it returns adds it to a film.
  FinishFrame keep(const SinkPicture& picture, const Annotations& annotations, const Draw& draw);

  /// Once all pictures are there.
  void finish();

 private:
  void name_files();
  FinishFrame to_file(const SinkPicture& picture, const Annotations& annotations, const Draw& draw);
  FinishFrame to_film(const SinkPicture& picture, const Annotations& annotations, const Draw& draw);

  const RenderCommand& command_;
  const PictureLayout& layout_;
  const FrameRun* run_;
  std::optional<NumberedPath> numbered_;
  std::unique_ptr<FilmWriter> film_;
  FrameAnnotations annotations_;
  std::mutex legend_;  ///< its letters come from one font, which one thread uses at a time
};

}  // namespace meniscus
