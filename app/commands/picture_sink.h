// SPDX-License-Identifier: BSD-3-Clause
// The destination of the pictures of `meniscus render`: a file, numbered files, or a film.
#pragma once

#include "app/commands/command_run.h"
#include "app/film/film.h"
#include "app/options/named_files.h"
#include "app/reports/run_frames.h"
#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/render/annotation.h"
#include "core/scene/frame_run.h"
#include "core/scene/scene.h"

namespace meniscus {

/// A picture to be drawn.
struct SinkPicture {
  std::uint64_t number = 0;  ///< number in the run
  std::uint64_t place = 0;   ///< index in the run, from 0
  std::uint64_t source = 0;  ///< number in the trajectory
  std::optional<double> time{};
  Camera camera{};
  /// The mattes that Framebuffer::seen indexes, and whether the picture has motion to the next frame. For EXR files.
  std::shared_ptr<const std::vector<Matte>> mattes{};
  bool moves = false;
};

/// The text and symbols in the pictures of a molecule, or of a run.
class FrameAnnotations {
 public:
  /// run: nullptr if there is one picture. The scene must stay valid. Throws InputError for a bad curve.
  FrameAnnotations(const Scene& scene, FrameRun* run);
  /// Returns the annotations of a picture. lengths: of dashed lines. Throws InputError for a label without atoms.
  Annotations of(const SinkPicture& picture, const Structure& structure,
                 std::span<const PlaceLabel> lengths = {}) const;
  /// Checks the annotations before the first picture. Throws the errors of annotate() if something does not fit with
  /// any of the cameras. structure: the molecule, or the first frame, whose labels need neither exist nor fit.
  void check(const PictureLayout& layout, std::span<const Camera> cameras, const Structure& structure) const;

 private:
  const AnnotationRequest& request_;
  bool is_run_;
  std::optional<Curve> curve_;  ///< the same in all pictures except for its mark
  double longest_ = 0.0;        ///< last time of the run, ps
  std::uint64_t last_ = 0;      ///< last frame of the run, by its number in the trajectory
};

/// Returns the path of numbered pictures; nothing if they become a film of this format and size. Called before anything
/// is read. Throws UsageError for an unsuitable name, and for an impossible film.
std::optional<NumberedPath> numbered_output(const std::string& path, const FilmFormat& format, glm::ivec2 size);

/// Throws OutputError if one of these pictures cannot be written; called before the first of them is made.
void check_pictures(const NumberedPath& path, std::span<const std::uint64_t> numbers, Existing existing);

/// Returns the background of a film with these pixels: by default white, unless the film keeps transparency.
std::optional<glm::vec3> ground_of_film(const std::optional<glm::vec3>& background, const FilmPixels& pixels);

class PictureSink {
 public:
  /// run: the run of the frames; nullptr: there is one picture. Throws UsageError for an unsuitable name, and for a
  /// film of a part of a run. The command, the layout and the run must stay valid.
  PictureSink(const RenderCommand& command, const PictureLayout& layout, FrameRun* run);

  /// Draws the molecule: in bands if a function takes them (RenderSettings::take_band), else as a whole.
  using Draw = std::function<Framebuffer(const RenderSettings& settings)>;
  /// Calls FrameAnnotations::of().
  Annotations annotations(const SinkPicture& picture, const Structure& structure,
                          std::span<const PlaceLabel> lengths = {}) const {
    return annotations_.of(picture, structure, lengths);
  }
  /// Calls FrameAnnotations::check().
  void check(std::span<const Camera> cameras, const Structure& structure) const {
    annotations_.check(layout_, cameras, structure);
  }
  /// Draws a picture, on any thread; the function that it returns adds it to a film.
  FinishFrame keep(const SinkPicture& picture, const Annotations& annotations, const Draw& draw);

  /// Must be called after all pictures.
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
  std::mutex legend_;  ///< its letters come from one font, which only one thread uses at a time
};

/// Returns a digest, as 64 hexadecimal digits, of the scene, the program's version, and the sizes and times of files
/// that the scene names. Pictures of a run that may be resumed have it as a note.
std::string made_of(const Scene& scene);

/// Returns the indices, in order, of paths whose picture is missing, incomplete or has another note. Throws UsageError
/// for pictures with another note, unless they may be replaced; and for files that are not PNG, which have no notes.
std::vector<std::size_t> missing_pictures(const std::vector<std::string>& paths, const std::string& made_of,
                                          Existing existing);

}  // namespace meniscus
