// SPDX-License-Identifier: BSD-3-Clause
// The notes that a command prints on standard error.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/scene_options.h"
#include "core/base/progress.h"
#include "core/scene/frame_run.h"
#include "core/scene/view_aim.h"

namespace meniscus {

/// Of a picture without a pixel of the molecule.
inline constexpr const char* kShowsNothing =
    "warning: the picture shows nothing: no ray meets a part of the surface that --show and --clip leave; check where "
    "the camera looks";

/// A line on stderr, unless quiet. Control characters are escaped.
void say(const SceneCommand& command, const std::string& line);

/// The warnings about a file on stderr, as detailed as wanted, unless quiet.
void say_warnings(const SceneCommand& command, const Structure& structure);

/// Warns that this share of a surface lies outside of the volume map that colours it, unless none does. whose: "the
/// surface".
void tell_beyond_map(const SceneCommand& command, double share, std::string_view whose);

/// Progress on stderr: a bar on a terminal, plain lines elsewhere, nothing when quiet.
ProgressSink progress_on_stderr(const SceneCommand& command);

/// Reads the file and says what was read and left out, and each warning. With --assembly list it prints the assemblies
/// and ends the program by CLI::Success.
Structure read_and_tell(const SceneCommand& command);

/// What was read and left out, each warning, and how many frames a run has.
void tell_run(const SceneCommand& command, const FrameRun& frames);

/// How much of the surface its map reaches, on which device it was computed, and whether radii grew.
void tell_built(const SceneCommand& command, const Molecule& molecule);
/// By how much radii were grown to tell ties apart, Å; nothing where it is 0.
void tell_grown_radii(const SceneCommand& command, double grown_by);

/// Computes and colours a structure, and says on which device.
Molecule build_and_tell(const SceneCommand& command, Structure structure);
/// The same of the molecule's file.
Molecule load_molecule(const SceneCommand& command);

/// On what a picture was made, and how long each stage took.
void say_times(const SceneCommand& command, const std::string& device, std::span<const StageTime> stages);

/// Warns if the camera given is certain to see nothing of the structure.
void tell_if_unseen(const SceneCommand& command, const std::optional<Camera>& given, const Structure& structure);

}  // namespace meniscus
