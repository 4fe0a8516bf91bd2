// SPDX-License-Identifier: BSD-3-Clause
// The notes that a command prints on standard error, and what a molecule file and a trajectory contain.
#pragma once

#include "app/options/scene_options.h"
#include "core/base/progress.h"
#include "core/scene/frame_run.h"
#include "core/scene/view_aim.h"
#include "core/structure/structure.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {

/// The warning about a picture without a pixel of the molecule.
inline constexpr const char* kShowsNothing =
    "warning: the picture shows nothing: no ray meets a part of the surface that --show and --clip leave; check where "
    "the camera looks";

/// Prints a line on standard error, unless quiet. Control characters are escaped.
void log_line(const SceneCommand& command, const std::string& line);

/// Prints the warnings about a file on standard error, in the requested detail, unless quiet.
void log_warnings(const SceneCommand& command, const Structure& structure);

/// Warns that a share of a surface lies outside its volume map, unless the share is 0. whose: "the surface".
void warn_beyond_map(const SceneCommand& command, double share, std::string_view whose);

/// Returns a sink for progress on standard error: a bar on a terminal, plain lines elsewhere, nothing when quiet.
ProgressSink progress_on_stderr(const SceneCommand& command);

/// Reads the file and prints which atoms were read and left out, and each warning. With --assembly list it prints the
/// assemblies and ends the program by CLI::Success.
Structure read_and_log(const SceneCommand& command);

/// Prints which atoms were read and left out, each warning, and the number of frames of a run.
void log_run(const SceneCommand& command, const FrameRun& frames);

/// Prints the part of the surface that its map covers, the device that computed it, and whether radii grew.
void log_surface(const SceneCommand& command, const Molecule& molecule);
/// Prints the growth of radii, Å, that resolved ties; nothing if it is 0.
void log_grown_radii(const SceneCommand& command, double grown_by);

/// Computes and colours a structure, and prints the device.
Molecule build_and_log(const SceneCommand& command, Structure structure);
/// Reads, computes and colours the molecule's file, and prints all of the above.
Molecule load_molecule(const SceneCommand& command);

/// Prints the device that made a picture, and the time of each stage.
void log_times(const SceneCommand& command, const std::string& device, std::span<const StageTime> stages);

/// Warns if the given camera certainly sees nothing of the structure.
void warn_if_unseen(const SceneCommand& command, const std::optional<Camera>& given, const Structure& structure);

/// Prints the assemblies of a structure on standard output.
void print_assemblies(const Structure& structure);

/// Prints atoms, frames, times, the first box, and where the file is cut short; warnings go to standard error.
void print_trajectory(Trajectory& trajectory);

}  // namespace meniscus
