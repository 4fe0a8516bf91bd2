// SPDX-License-Identifier: BSD-3-Clause
// A bundle is a folder with a run of frames that any machine can work on; its bundle.json describes the work.
#pragma once

#include "app/film/film.h"

namespace meniscus::farm {

/// A kind of work on every frame. A picture of a renderer needs the scene of the same frame, nothing else.
enum class Step {
  surface,  ///< scenes for a renderer, by this program
  render    ///< pictures
};

/// The program that makes the frames of a step.
enum class Maker {
  meniscus,  ///< this program
  povray,    ///< one process for each frame
  blender    ///< one process for many frames
};

/// A command that makes frames, and how a bundle divides its work.
struct CommandKind {
  std::string_view name;    ///< "render" or "export povray"
  std::vector<Step> steps;  ///< in order; the last one makes the results
  Maker renderer;           ///< the program of Step::render
};

/// Returns the kind of {"render", ...} or {"export", "povray", ...}. Throws RequestError for other commands.
const CommandKind& kind_of(const std::vector<std::string>& command);

/// A file that the command reads.
struct Input {
  std::string path;  ///< relative to the bundle; absolute if the bundle only refers to it
  std::uint64_t bytes = 0;
  std::string sha256;
};

/// The film that `farm verify` makes of the pictures.
struct Film {
  std::string file;  ///< a plain name, in the bundle
  FilmFormat format;
};

/// The most tasks of a bundle, because Slurm's MaxArraySize is 1001 unless a site says otherwise.
inline constexpr std::uint64_t kMostTasks = 1000;

/// How the run is cut into tasks, and what each task needs.
struct Chunking {
  std::optional<std::uint64_t> wanted_frames;  ///< frames of a task; without them the time decides
  double wanted_minutes = 5.0;                 ///< time of a task
  std::optional<double> seconds_per_frame;     ///< time of the trial frame, in all steps
  std::uint64_t count = 1;                     ///< tasks
  std::uint64_t cores = 2;                     ///< cores of a task
  std::optional<std::uint64_t> wanted_memory;  ///< memory of a task, in MiB
  std::optional<std::uint64_t> peak_memory;    ///< memory of the largest process of the trial frame, in MiB

  /// Returns the number of tasks, from 1 to frame_count, that have the wanted frames or the wanted time.
  std::uint64_t wanted_count(std::uint64_t frame_count) const;
  /// Returns the memory of a task in MiB: the wanted memory, or half as much again as was measured, since other frames
  /// may need more, and 256 MiB for the worker itself. Returns nothing if neither is known.
  std::optional<std::uint64_t> memory() const;
};

/// Everything that a worker needs to know. Nothing in it depends on time, machine or user, except the measurements of
/// the trial frame and the number of tasks that follows from them.
struct Bundle {
  std::string program_version;        ///< with its commit (app/process/program_main.h)
  std::vector<std::string> command;   ///< {"render", "inputs/a.pdb", ...}: this program's words, run in the bundle
  std::vector<std::string> device;    ///< options that say where this program computes
  std::vector<std::string> renderer;  ///< options of POV-Ray or of Blender's driver
  std::vector<std::uint64_t> frames;  ///< frames of the run, by their numbers in the trajectory
  std::vector<Input> inputs;
  int width = 0, height = 0;  ///< size of the pictures, in pixels
  std::optional<Film> film;
  Chunking chunking;

  const std::vector<Step>& steps() const { return kind_of(command).steps; }
  Maker maker(Step step) const { return step == Step::surface ? Maker::meniscus : kind_of(command).renderer; }
  /// Returns the path of a step's results in the bundle, with ##### for the number of the frame. This file is the last
  /// one of its frame to appear.
  std::string result_pattern(Step step) const;
  /// Returns the path of a step's result for one frame, relative to the bundle.
  std::string result(Step step, std::uint64_t frame) const;
};

/// Returns part K of N of the run, from 1: consecutive frames. Sizes of parts differ by one at most.
std::vector<std::uint64_t> chunk_of(const Bundle& bundle, std::uint64_t k, std::uint64_t n);

/// Returns the pattern with the frame's number, of five digits or more, instead of #####.
std::string numbered(std::string_view pattern, std::uint64_t frame);

/// Returns the text of bundle.json, with a line end.
std::string bundle_json(const Bundle& bundle);

/// Reads DIR/bundle.json. Throws InputError if it is missing, damaged, or of another schema.
Bundle read_bundle(const std::filesystem::path& folder);

}  // namespace meniscus::farm
