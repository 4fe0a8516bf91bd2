// SPDX-License-Identifier: BSD-3-Clause
// The figures that a command makes from a scene: one of a molecule, or one of each frame of a run.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "app/options/scene_options.h"
#include "app/reports/run_frames.h"
#include "core/camera/camera.h"
#include "core/color/color_key.h"
#include "core/queries/surface_object.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "core/scene/run_framing.h"
#include "core/scene/shown_frames.h"
#include "core/scene/view_aim.h"

namespace meniscus {

/// A figure on its way to where it is drawn or written.
struct FigureFrame {
  std::uint64_t number = 0;    ///< in the run, by which files are named
  std::uint64_t source = 0;    ///< in the trajectory
  std::uint64_t place = 0;     ///< in the run, from 0
  std::optional<double> time;  ///< ps
  Figure figure;
  Camera camera;
  std::vector<glm::dvec3> velocities;  ///< RunFrame::velocities
};

/// What the figures of a run need while they are made.
struct FigureWork {
  std::uint64_t bytes_per_atom = 0;     ///< that a frame takes until it is finished
  std::uint64_t bytes_per_frame = 0;    ///< on top of that, however many atoms it has
  const EglContext* context = nullptr;  ///< in which surfaces on GL are made; nullptr: in one of their own
};

/// A picture is a run of one frame: one loop makes both. Of one molecule the figure is made at once; of a run each is
/// made when its turn comes, several at a time.
class FigureRun {
 public:
  /// Reads the molecule and computes its figure, or opens the run; and says so. Throws what reading and computing
  /// throw.
  explicit FigureRun(const SceneCommand& command, Velocities velocities = Velocities::none);

  /// Finds the camera of each frame. picture: with the size of the part that the molecule has. extent: framing() also
  /// has the box around all frames. Throws as run_cameras does.
  void aim(const ViewRequest& picture, bool extent);

  /// The camera for another picture of the same, of a run for all its frames. given: by a file. Throws as aim().
  Camera camera_for(const ViewRequest& picture, const std::optional<Camera>& given);
  /// Takes from all frames what the colours of a scheme mean in each; of one molecule nothing changes.
  void measure(ColorScheme& color);

  bool is_run() const { return frames_ != nullptr; }
  /// The command with its selections settled, the atoms beside the surface asked for, and colours measured.
  const SceneCommand& command() const { return command_; }
  const Scene& scene() const { return command_.scene; }
  /// Of a run: must be one.
  FrameRun& frames() { return *frames_; }
  const RunFraming& framing() const { return framing_; }
  const Camera& camera(std::uint64_t place) const { return framing_.cameras[framing_.cameras.size() == 1 ? 0 : place]; }
  /// Returns the camera of the next place; at the last place, that place's own.
  const Camera& next_camera(std::uint64_t place) const {
    return framing_.cameras[std::min<std::size_t>(place + 1, framing_.cameras.size() - 1)];
  }
  /// --save-camera, once they are found. Throws OutputError.
  void save_cameras() const;
  /// Of one molecule: must be.
  const Figure& figure() const { return *figure_; }
  /// Of the molecule, or at the first frame of the run; as it is shown.
  const Structure& structure() const { return frames_ ? shown_->first_shown() : figure_->molecule.structure; }
  /// With all atoms that any frame may have.
  const Structure& reach() const { return frames_ ? frames_->reach() : figure_->molecule.structure; }
  /// What the colours of all figures mean.
  ColorKey key() const;

  /// Makes what leads from a figure to its file, perhaps on a thread of its own; what it returns is done in the order
  /// of the frames.
  using Sink = std::function<FinishFrame(FigureFrame frame)>;
  /// Hands all figures to sinks: each thread has one of its own. Of one molecule what the sink throws is thrown. Throws
  /// as run_frames does.
  void make(const FigureWork& work, const std::function<Sink()>& make_sink);

 private:
  void open_run(Velocities velocities);
  void make_one_figure();
  void tell_idle_cuts() const;

  SceneCommand command_;
  GivenCameras given_;  ///< by files
  std::unique_ptr<FrameRun> frames_;
  std::unique_ptr<ShownFrames> shown_;
  RunFraming framing_;
  std::optional<Figure> figure_;  ///< of one molecule
  std::optional<ViewAim> aim_;
};

/// Makes one object of several copies where planes are to cut them, each elsewhere, or where they differ.
void settle_copies(std::vector<SurfaceObject>& objects, bool are_cut);

/// Throws UsageError if caps would have to show values of a map, which the files do not hold. reason: that sentence.
void check_caps_of_map(const Scene& scene, std::string_view reason);

/// Before anything is computed. Throws OutputError if the file of --save-camera cannot be written.
void check_saved_camera(const SceneCommand& command);

/// --save-camera: writes the camera, or where it moves those of all frames as the keys of a path. frames: their
/// numbers; none of one molecule. Throws OutputError.
void save_cameras(const SceneCommand& command, std::span<const Camera> cameras, std::span<const std::uint64_t> frames);

/// As run_frames takes them.
MadeFrame made_frame(std::span<const std::filesystem::path> files);

/// Runs a command whose options are taken, and saves its scene, if that is asked for, when all is done. Throws what
/// `run` throws, and OutputError before it if the scene cannot be saved.
void run_and_save_scene(const SceneCommand& command, const std::function<void()>& run);

}  // namespace meniscus
