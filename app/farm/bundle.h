// SPDX-License-Identifier: BSD-3-Clause
// A run of frames as a folder that any machine can work on: the content of bundle.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/film/film_format.h"

namespace meniscus::farm {

inline constexpr int kLargestSide = 65'535;                 ///< of a picture, in pixels
inline constexpr std::int64_t kMostPixels = 1'000'000'000;  ///< of a picture

/// What makes the frames of a step.
enum class Maker {
  meniscus,  ///< this program: pictures, scenes, geometry
  povray,    ///< one process a frame
  blender    ///< one process for many frames
};

/// One kind of work on every frame. A frame of a step needs the same frame of the step before, nothing else.
struct Step {
  std::string name;  ///< "surface", "render"
  Maker maker = Maker::meniscus;
  std::vector<std::string> arguments;  ///< more of them: devices of this program, POV-Ray's, those of Blender's driver
};

/// A file the command reads: in the bundle, or elsewhere.
struct Input {
  std::string path;  ///< relative to the bundle
  std::uint64_t bytes = 0;
  std::string sha256;
  std::string source = {};  ///< by reference: where it is if it is not in the bundle; an absolute path of plain names
};

/// The film that `farm verify` makes of the pictures.
struct Film {
  std::string file;  ///< plain name, in the bundle
  double frames_per_second = 25.0;
  FilmFormat format;
};

/// How the run is cut into tasks, and what each needs: as asked for, and as decided.
struct Chunking {
  std::optional<std::uint64_t> asked_frames;  ///< a task; else by time
  double asked_minutes = 5.0;                 ///< a task
  std::optional<double> seconds_per_frame;    ///< of the slowest step, measured when the bundle was made
  std::uint64_t count = 1;                    ///< tasks of each step
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

/// How often a frame that fails is tried.
struct Tries {
  static constexpr std::uint64_t kMost = 100;
  static constexpr double kShortestWait = 0.1, kLongestWait = 3600.0;  ///< seconds

  std::uint64_t most = 1;      ///< after so many failed ones it has failed
  double wait_seconds = 10.0;  ///< before the second; doubled before each further one, up to kLongestWait

  /// Seconds before the next, after so many failed ones; nothing if it was the last.
  std::optional<double> wait_after(std::uint64_t failed) const;
};

/// Everything a worker needs to know. Nothing in it depends on time, machine or user, but what was measured
/// and follows of it.
struct Bundle {
  std::string program_version;        ///< with its commit (app/process/this_program.h)
  std::vector<std::string> command;   ///< of the program, as {"render", "inputs/a.pdb", ...}; paths are relative
  std::vector<std::uint64_t> frames;  ///< of the run, by their numbers in the trajectory
  std::vector<Step> steps;            ///< in order
  std::vector<Input> inputs;
  int width = 0, height = 0;  ///< of the pictures, in pixels
  std::optional<Film> film;
  Chunking chunking;
  Tries tries;  ///< unless the worker is told otherwise

  /// Of what decides how a frame looks. Work done for another bundle never counts for this one.
  std::string fingerprint() const;
  /// Place of a frame in the run, from 0. Throws RequestError if it is not in it.
  std::size_t place_of(std::uint64_t frame) const;
  const Step* step(const std::string& name) const;  ///< nullptr: there is none
  /// Whether the last step makes pictures; else scenes for a renderer that is not a step.
  bool makes_pictures() const { return step("render") != nullptr; }
};

/// Part K of N of the run, K from 1: frames that follow each other in it, sizes differing by one at most.
std::vector<std::uint64_t> chunk_of(const Bundle& bundle, std::uint64_t k, std::uint64_t n);

/// "00042": as frames are numbered in names of files.
std::string frame_digits(std::uint64_t frame);

/// The text of bundle.json, with a line end.
std::string bundle_json(const Bundle& bundle);

/// Understands that text. Throws RequestError: damaged, or of another schema.
Bundle parse_bundle(const std::string& text);

/// Whether both are the same but for what was measured.
bool same_but_for_measurement(const Bundle& a, const Bundle& b);

}  // namespace meniscus::farm
