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
};

/// The folder and the device on which a step runs.
struct Workplace {
  std::filesystem::path folder;     ///< the bundle
  std::vector<std::string> device;  ///< options of this program, which count before those of the bundle
  int threads = 0;                  ///< of each process; 0: what the bundle says, else as many as it likes
};

/// Makes these frames of the step, in this order. It reports a frame that fails, and goes on with the others.
/// A process that a signal ends is started once more, for one frame after another, so that it is known which frame
/// ended it. Throws RunError with the process' own exit code where it cannot work at all, InputError if it cannot be
/// started.
void make_frames(const Bundle& bundle, Step step, const Workplace& place, const std::vector<std::uint64_t>& frames,
                 const FrameListener& listener);

/// Makes frames by a program that tells of each by a line of JSON, {"frame":42,"state":"done","files":[...],"ms":1.5}
/// or {"frame":42,"state":"failed","exit":7,"error":"..."}, in the order of the list. `command_for` gives the words of
/// its command line for a list of frames; `alone`: it makes one frame at a time.
void make_by_lines(
    const std::function<std::vector<std::string>(const std::vector<std::uint64_t>& frames, bool alone)>& command_for,
    const std::filesystem::path& folder, std::vector<std::uint64_t> frames, const FrameListener& listener);

/// A PNG file without its chunks of time and text (tIME, tEXt, zTXt, iTXt; PNG, W3C 2003), so that the same picture is
/// the same file. Pixels and colour space stay as they are. Throws RunError (kExitInput) if it is no whole PNG.
std::string png_without_time(std::string_view file);

/// Removes the unfinished files that killed workers left in a bundle.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace meniscus::farm
