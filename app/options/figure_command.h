// SPDX-License-Identifier: BSD-3-Clause
// What commands have in common that draw a figure, of one molecule or of a run of frames: their options.
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "app/options/frame_options.h"
#include "app/options/molecule_options.h"
#include "core/camera/view_request.h"
#include "core/scene/figure.h"
#include "core/scene/run_cameras.h"

namespace meniscus {

/// What is shown, from where, of which frames, and where it goes. Commands keep one of these alive as long as their
/// CLI::App.
struct FigureCommand {
  MoleculeOptions molecule;
  FigureRequest figure;
  ViewRequest picture;
  FrameOptions frames;
  CameraMotionRequest run_camera;
  OutputOptions output;
  std::string save_scene, save_camera;  ///< paths; empty: it is not saved
};

/// The molecule, what a figure shows of it, and --interface.
void add_shown_options(CLI::App& command, FigureCommand& figure);
/// Size and camera of the picture, and the run of frames; behind the above.
void add_run_options(CLI::App& command, FigureCommand& figure);

/// The command, its selections settled (settle_selections).
FigureCommand& with_settled_selections(FigureCommand& command);

/// Runs an export whose options are parsed, and saves its scene, if that is asked for, when it is done. Throws what
/// `run` throws, and OutputError before it if the scene cannot be saved.
void run_export(const CLI::App& command, FigureCommand& figure, const std::function<void()>& run);

}  // namespace meniscus
