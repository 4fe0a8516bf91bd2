// SPDX-License-Identifier: BSD-3-Clause
// A molecule, or the frames of a run, that a command takes one after another as numbers or as figures; the options of
// `meniscus render` in addition to its scene; and scenes that commands read from files.
#pragma once

#include "app/options/scene_options.h"
#include "app/reports/csv_tables.h"
#include "app/reports/run_frames.h"
#include "core/camera/camera.h"
#include "core/color/color_key.h"
#include "core/queries/surface_object.h"
#include "core/render/image_output.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/scene/run_framing.h"
#include "core/scene/scene_picture.h"
#include "core/scene/view_aim.h"
#include "core/structure/structure.h"

namespace meniscus {

struct RenderCommand : SceneCommand {
  bool provenance = false;    ///< true if the picture contains the command line
  bool names_program = true;  ///< true if the picture contains the program's version, and a single picture its scene
  bool keeps_scene = false;   ///< true if the picture contains the scene
  bool stats = false;
  bool is_draft = false;
  bool resumes = false;  ///< true if existing pictures of a run stay
  std::string made_of;   ///< made_of() for a run that resumes
};

/// Returns render_settings(), with times of stages if they are printed.
RenderSettings picture_settings(const RenderCommand& command, const PictureLayout& layout);

/// Returns the settings for writing pictures.
ImageSettings image_settings(const RenderCommand& command);

/// Makes pictures of only the part that the view needs (--extent): of a molecule, or of the frames of a run.
void render_views(const RenderCommand& command);

/// Returns the options of the command line that also hold for each scene. but: keys of options that do not.
std::vector<std::string> shared_words(const SceneOptions& options, std::span<const std::string_view> but);

/// Reads the scene of a file or a picture, as `meniscus render --scene FILE words...` does. Options without effect are
/// not reported. Throws like SceneOptions::take(); UsageError for a scene that does not show surfaces.
SceneCommand read_scene_file(const std::string& path, std::vector<std::string> words, const Reporting& reporting);

/// Turns the scene into a draft (--draft): half its width and height, with letters and lines, one ray per pixel and no
/// traced shade. It takes a fraction of the time.
void make_draft(Scene& scene);

/// A structure and its frame.
struct NumberedStructure {
  Structure structure;
  Structure together;             ///< RunFrame::together; a single molecule has it, too
  std::optional<FrameNote> note;  ///< the frame; nothing for a single molecule
  std::uint64_t number = 0;       ///< number of the frame in the run, which names files
};

/// The structures of a molecule or a run, passed on by one loop: a molecule is a run of one frame.
class NumberRun {
 public:
  /// command: has resolved selections, and must outlive this object. Reads the molecule or opens the run, and prints
  /// what it read. Throws the errors of reading.
  explicit NumberRun(const SceneCommand& command);

  bool is_run() const { return frames_ != nullptr; }
  /// Returns the frames. The command must make a run.
  const FrameRun& frames() const { return *frames_; }
  /// Returns the structure of the molecule, or of the first frame of the run.
  const Structure& structure() const { return frames_ ? frames_->structure() : molecule_; }

  /// Does the part of the work that can run at the same time as other frames, perhaps on a thread of its own; the
  /// function that it returns runs in the order of the frames.
  using Worker = std::function<FinishFrame(NumberedStructure structure)>;
  /// Passes all structures to workers; each thread has a worker of its own, with a builder. At the end commit() keeps
  /// the results, even if some frames failed. Throws like run_frames; for a single molecule, the errors of the worker.
  void make(std::uint64_t bytes_per_atom,
            const std::function<Worker(const std::shared_ptr<MoleculeBuilder>& builder)>& make_worker,
            const std::function<void()>& commit);

 private:
  void make_molecule(const Worker& worker);
  void make_frames(std::vector<FrameWorker> workers, const std::function<void()>& commit);

  const SceneCommand& command_;
  std::unique_ptr<FrameRun> frames_;
  Structure molecule_;  ///< empty for a run
};

/// Returns the number of an atom of the structure that is the same in all frames of the run, and unique.
std::uint32_t lasting_number(const Structure& structure, std::uint32_t atom);

/// A figure and its frame.
struct FigureFrame {
  std::uint64_t number = 0;    ///< number in the run, which names files
  std::uint64_t source = 0;    ///< number in the trajectory
  std::uint64_t place = 0;     ///< index in the run, from 0
  std::optional<double> time;  ///< ps
  Figure figure;
  Camera camera;
  std::vector<glm::dvec3> velocities;  ///< RunFrame::velocities
};

/// The resources that the figures of a run need.
struct FigureWork {
  std::uint64_t bytes_per_atom = 0;     ///< memory of a frame until it is finished, per atom
  std::uint64_t bytes_per_frame = 0;    ///< in addition to that, for any number of atoms
  const EglContext* context = nullptr;  ///< the context for surfaces on GL; nullptr: one of their own
};

/// The figures of a molecule or a run, made by one loop: a picture is a run of one frame. The figure of one molecule is
/// made at once; figures of a run are made in turn, several at a time.
class FigureRun {
 public:
  /// Computes the figure of a molecule, or opens the run; prints what it read. Throws the errors of both.
  explicit FigureRun(const SceneCommand& command, Velocities velocities = Velocities::none);

  /// Finds the camera of each frame. picture: with the size of the part of the picture for the molecule. extent:
  /// framing() also has the box around all frames. Throws like run_cameras.
  void aim(const ViewRequest& picture, bool extent);

  /// Chooses and returns the height of a picture that ends at its molecule (ViewRequest::fits). Call it before aim().
  int fit();

  /// Returns the camera for another picture of the same figure; in a run, for all frames. given: a camera from a file.
  /// Throws the errors of aim().
  Camera camera_for(const ViewRequest& picture, const std::optional<Camera>& given);
  /// Measures in all frames the numbers by which a scheme colours; does nothing for a single molecule.
  void measure(ColorScheme& color);

  bool is_run() const { return frames_ != nullptr; }
  /// Returns the command with resolved selections, with the atoms next to the surface, and with measured colours.
  const SceneCommand& command() const { return command_; }
  const Scene& scene() const { return command_.scene; }
  /// Returns the frames. The command must make a run.
  FrameRun& frames() { return *frames_; }
  const RunFraming& framing() const { return framing_; }
  const Camera& camera(std::uint64_t place) const { return framing_.cameras[framing_.cameras.size() == 1 ? 0 : place]; }
  /// Returns the camera of the next frame; at the last frame, its own camera.
  const Camera& next_camera(std::uint64_t place) const {
    return framing_.cameras[std::min<std::size_t>(place + 1, framing_.cameras.size() - 1)];
  }
  /// Saves the cameras for --save-camera, once they are found. Throws OutputError.
  void save_cameras() const;
  /// Returns the figure. The command must make a single molecule.
  const Figure& figure() const { return *figure_; }
  /// Returns the shown structure, of the molecule or of the first frame of the run.
  const Structure& structure() const { return frames_ ? shown_->first_shown() : figure_->molecule.structure; }
  /// Returns the structure with all atoms that any frame may have.
  const Structure& possible_structure() const {
    return frames_ ? frames_->possible_structure() : figure_->molecule.structure;
  }
  /// Returns the meaning of the colours of all figures.
  ColorKey key() const;

  /// Makes the file of a figure, perhaps on another thread; the function that it returns runs in the order of frames.
  using Sink = std::function<FinishFrame(FigureFrame frame)>;
  /// Passes all figures to sinks; each thread has a sink of its own. For a single molecule, the errors of the sink are
  /// thrown. Throws like run_frames.
  void make(const FigureWork& work, const std::function<Sink()>& make_sink);

 private:
  void open_run(Velocities velocities);
  void make_one_figure();
  void log_ineffective_cuts() const;
  PictureFit fitted(ViewRequest picture) const;

  SceneCommand command_;
  GivenCameras given_;  ///< cameras from files
  std::unique_ptr<FrameRun> frames_;
  std::unique_ptr<ShownFrames> shown_;
  RunFraming framing_;
  std::optional<Figure> figure_;  ///< for a single molecule
  std::optional<ViewAim> aim_;
};

/// Merges several copies into one object if planes cut them at different places, or if the copies differ.
void merge_copies(std::vector<SurfaceObject>& objects, bool are_cut);

/// Throws UsageError if caps would have to show values of a map, which the files do not contain. reason: the message.
void check_caps_of_map(const Scene& scene, std::string_view reason);

/// Throws OutputError if the file of --save-camera cannot be written; must be called before anything is computed.
void check_saved_camera(const SceneCommand& command);

/// Saves the camera for --save-camera; if it moves, the cameras of all frames as the keys of a path. frames: their
/// numbers; empty for a single molecule. Throws OutputError.
void save_cameras(const SceneCommand& command, std::span<const Camera> cameras, std::span<const std::uint64_t> frames);

/// Returns the result of a frame in the form that run_frames takes.
MadeFrame made_frame(std::span<const std::filesystem::path> files);

/// Runs a command whose options are taken, and then saves its scene, if requested. Throws the errors of `run`, and
/// OutputError before it if the scene cannot be saved.
void run_and_save_scene(const SceneCommand& command, const std::function<void()>& run);

}  // namespace meniscus
