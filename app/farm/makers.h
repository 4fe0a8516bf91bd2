// SPDX-License-Identifier: BSD-3-Clause
// The programs that make the frames of a step, and what they report about each frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/farm/bundle.h"

namespace meniscus::farm {

/// Hears of each frame, once, as soon as it is over.
struct FrameListener {
  /// files: paths relative to the bundle.
  std::function<void(std::uint64_t frame, const std::vector<std::string>& files, double seconds)> done;
  std::function<void(std::uint64_t frame, int exit_code, const std::string& error)> failed;
  /// Hears, before the above, of a frame whose process was ended by a signal and that is tried a second time.
  std::function<void(std::uint64_t frame, const std::string& error)> tried_again;
  /// Hears each line that a process says, but those about frames, before it hears of the frame that is over then. Not
  /// those said while it makes several at once: their frame is then unknown.
  std::function<void(const std::string& line)> said;
};

/// Where and with what a step is made.
struct Workplace {
  std::filesystem::path folder;             ///< the bundle
  std::vector<std::string> device_options;  ///< of this program, instead of those of the bundle; empty: those
  int threads = 0;                          ///< of each process; 0: what the bundle says, else as many as it likes
};

/// Makes these frames of the step, in this order; a frame that fails is told, and the others are made all the same.
/// Throws RunError with the maker's own exit code where it cannot work at all, InputError if it cannot be started.
void make_frames(const Bundle& bundle, const Step& step, const Workplace& place,
                 const std::vector<std::uint64_t>& frames, const FrameListener& listener);

/// The same by a program that tells each frame by a line of JSON, {"frame":42,"state":"done","files":[...],"ms":1.5} or
/// {"frame":42,"state":"failed","exit":7,"error":"..."}, in the order of the list. `command_for` gives its arguments
/// for a list of frames; `alone`: that it makes one after another, not several at once. A program that makes several at
/// once says so before it begins them: {"event":"start","at_once":3}. If a signal ends it, another process goes on
/// after the last frame told, with one frame after another, so that it is known which one it was at; if that ends so,
/// too, and at the same frame, the frame has failed, and a third makes the others.
void make_by_lines(
    const std::function<std::vector<std::string>(const std::vector<std::uint64_t>& frames, bool alone)>& command_for,
    const std::filesystem::path& folder, std::vector<std::uint64_t> frames, const FrameListener& listener);

/// The same by POV-Ray, one process a frame, from scene/ into images/; a second one if a signal ends the first.
void make_by_povray(const Bundle& bundle, const Step& step, const Workplace& place,
                    const std::vector<std::uint64_t>& frames, const FrameListener& listener);

/// Removes unfinished pictures of this process, and its copy of Blender's driver.
void remove_own_leftovers(const std::filesystem::path& folder);
/// Removes whatever killed workers left unfinished. For a bundle without running workers.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace meniscus::farm
