// SPDX-License-Identifier: BSD-3-Clause
// A run of frames as a folder that any machine can work on: the content of bundle.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/film/film_format.h"

namespace meniscus::farm {

/// One kind of work on every frame. A picture of a renderer needs the scene of the same frame, nothing else.
enum class Step {
  surface,  ///< scenes for a renderer, by this program
  render    ///< pictures
};

std::string_view word_of(Step step);

/// What makes the frames of a step.
enum class Maker {
  meniscus,  ///< this program
  povray,    ///< one process a frame
  blender    ///< one process for many frames
};

/// A file that the command reads.
struct Input {
  std::string path;  ///< relative to the bundle; absolute if the bundle only refers to it
  std::uint64_t bytes = 0;
  std::string sha256;
};

/// The film that `farm verify` makes of the pictures.
struct Film {
  std::string file;  ///< plain name, in the bundle
  double frames_per_second = 25.0;
  FilmFormat format;
};

/// How the run is cut into tasks, and what each needs: as asked for, and as decided.
struct Chunking {
  std::optional<std::uint64_t> asked_frames;  ///< of a task; else the time decides
  double asked_minutes = 5.0;                 ///< of a task
  std::optional<double> seconds_per_frame;    ///< of the trial frame, in all steps
  std::uint64_t count = 1;                    ///< tasks
  std::uint64_t cores = 2;                    ///< of a task
  std::optional<std::uint64_t> asked_memory;  ///< of a task, in MiB
  std::optional<std::uint64_t> peak_memory;   ///< of the largest process of the trial frame, in MiB

  /// Tasks of as many frames, or as much time, as was asked for: at least 1.
  std::uint64_t wanted_count(std::uint64_t frame_count) const;
  /// Decides `count` for so many frames: what is wanted, at most 1000, for queues take arrays of 1000 by default.
  void decide(std::uint64_t frame_count);
  /// Memory that a task should be given, in MiB: what was asked for; else half as much again as was measured, for other
  /// frames may need more, and something for the worker itself. Nothing if neither is known.
  std::optional<std::uint64_t> memory() const;
};

/// Everything a worker needs to know. Nothing in it depends on time, machine or user, but what was measured and
/// follows from it.
struct Bundle {
  std::string program_version;        ///< with its commit (app/process/this_program.h)
  std::vector<std::string> command;   ///< {"render", "inputs/a.pdb", ...}: as this program is run in the bundle
  std::vector<std::string> device;    ///< options that say where this program computes
  std::vector<std::string> renderer;  ///< options of POV-Ray or of Blender's driver
  std::vector<std::uint64_t> frames;  ///< of the run, by their numbers in the trajectory
  std::vector<Input> inputs;
  int width = 0, height = 0;  ///< of the pictures, in pixels
  std::optional<Film> film;
  Chunking chunking;

  /// Returns the steps in order. The last one makes the results of the bundle.
  std::vector<Step> steps() const;
  Maker maker(Step step) const;
  /// Where the results of a step lie in the bundle, with ##### for the number of the frame. That file is the last of
  /// its frame to appear.
  std::string result_pattern(Step step) const;
};

/// The steps of {"render", ...} or {"export", "povray", ...}. Throws RequestError for a command that cannot be bundled.
std::vector<Step> steps_of(const std::vector<std::string>& command);

/// Part K of N of the run, K from 1: frames that follow each other in it, sizes differing by one at most.
std::vector<std::uint64_t> chunk_of(const Bundle& bundle, std::uint64_t k, std::uint64_t n);

/// The pattern with the frame's number, of five digits or more, instead of #####.
std::string numbered(std::string_view pattern, std::uint64_t frame);

/// The text of bundle.json, with a line end.
std::string bundle_json(const Bundle& bundle);

/// Whether both are the same but for what was measured.
bool same_but_for_measurement(const Bundle& a, const Bundle& b);

/// Reads DIR/bundle.json. Throws InputError: missing, damaged, or of another schema.
Bundle read_bundle(const std::filesystem::path& folder);

}  // namespace meniscus::farm
