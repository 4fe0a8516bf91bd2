// SPDX-License-Identifier: BSD-3-Clause
// The options that make a run of frames out of a command for one molecule.
#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

#include "app/film/film_format.h"
#include "core/scene/frame_run.h"

namespace meniscus {

/// How a run of frames tells how far it is.
enum class ProgressStyle {
  automatic,  ///< a bar on a terminal, else plain lines
  bar,
  plain,   ///< a line at every tenth
  json,    ///< a JSON object a line on standard error: start, each frame, end
  openjd,  ///< openjd_progress and openjd_status lines on standard output, as OpenJD 2023-09 defines them
  none
};

/// What the frame options say. Commands keep one of these alive as long as their CLI::App.
struct FrameOptions : RunRequest {
  ProgressStyle progress = ProgressStyle::automatic;
  std::size_t jobs = 0;  ///< frames that are made at once; 0: as cores and memory allow
};

/// Which frames there are, how their atoms are moved, and how many are made at once: --trajectory to --progress.
void add_frame_options(CLI::App& command, FrameOptions& options);
/// Trajectories named behind FILE, for what has --trajectory. To be called behind what adds FILE and before
/// add_frame_options.
void add_trajectory_argument(CLI::App& command);
/// --codec, --crf, --bits, --chroma. `format` must live as long as the command.
void add_film_options(CLI::App& command, FilmFormat& format);
void add_progress_option(CLI::App& command, ProgressStyle& style);

/// Where indices of frames and compiled kernels are kept: beside other caches of the user, or nowhere.
std::string cache_folder();

}  // namespace meniscus
