// SPDX-License-Identifier: BSD-3-Clause
// Steps that the exports of figures to other renderers share: what they refuse, what they load, and how they go
// through a run of frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "app/options/figure_command.h"
#include "app/reports/run_frames.h"
#include "core/camera/camera.h"
#include "core/queries/surface_object.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/scene/run_framing.h"
#include "core/scene/view_aim.h"

namespace meniscus {

/// Before anything is computed: what a scene cannot have if it is of a run, or of one molecule. program: " in POV-Ray",
/// as it stands behind "a run of frames"; may be empty. Throws UsageError, OutputError for a camera that cannot be
/// saved.
void check_export(const FigureCommand& command, std::string_view program);

/// Throws UsageError if caps would have to show values of a map, which the files do not hold. reason: that sentence.
void check_caps_of_map(const FigureCommand& command, std::string_view reason);

/// The figure of one molecule, and the camera that aims at it.
struct AimedFigure {
  Figure figure;
  ViewAim aim;
  std::optional<Camera> given;

  /// picture: with the size of the part that the molecule has. Says which cuts have nothing to do as this camera sees
  /// the molecule.
  Camera camera(const FigureCommand& command, const ViewRequest& picture) const;
};

/// Reads, computes and says what came of it. Throws as load_aimed_molecule and make_figure do.
AimedFigure aimed_figure(const FigureCommand& command);

/// Says which cuts have nothing to do in the first frame of a run.
void tell_idle_cuts(const FigureCommand& command, const FrameRun& frames, const Camera& camera);

/// Before planes cut: where they stand, a copy is cut as no other is, so that copies become one object.
void settle_copies(std::vector<SurfaceObject>& objects);

/// As run_frames takes them.
MadeFrame made_frame(std::span<const std::filesystem::path> files);

/// A run of frames that is exported, with what all of its frames share.
class ExportRun {
 public:
  /// Opens it and says so, finds cameras and extent, and measures the colours of the command that are of all frames.
  /// velocities: frames shall have them. The command must stay. Throws as FrameRun, given_cameras and run_framing do.
  explicit ExportRun(FigureCommand& command, bool velocities = false);

  FrameRun& frames() { return frames_; }
  const RunFraming& framing() const { return framing_; }
  const Camera& camera(std::uint64_t place) const;

  using MakeFrame = std::function<FinishFrame(MoleculeBuilder& builder, RunFrame frame)>;
  /// Has each frame of the chunk made by `make`, several at once on threads. bytes_per_atom: what a frame takes until
  /// it is finished. Throws as run_frames does.
  void run(std::uint64_t bytes_per_atom, const MakeFrame& make);

 private:
  ExportRun(FigureCommand& command, const GivenCameras& cameras, bool velocities);

  const FigureCommand& command_;
  FrameRun frames_;
  RunFraming framing_;
};

}  // namespace meniscus
