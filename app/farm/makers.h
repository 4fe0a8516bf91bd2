// SPDX-License-Identifier: BSD-3-Clause
// The programs that make the frames of a step, and what they tell about each frame.
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

/// Where and with what a step is made.
struct Workplace {
  std::filesystem::path folder;             ///< the bundle
  std::vector<std::string> device_options;  ///< of this program, instead of those of the bundle; empty: those
  int threads = 0;                          ///< for the renderers; 0: as many as they like
};

/// Makes these frames of the step, in this order; a frame that fails is told, and the others are made all the same.
/// Throws RunError with the maker's own exit code where it cannot work at all, InputError if it cannot be started.
void make_frames(const Bundle& bundle, const Step& step, const Workplace& place,
                 const std::vector<std::uint64_t>& frames, const FrameListener& listener);

/// The same by a program that tells each frame by a line of JSON, {"frame":42,"state":"done","files":[...],"ms":1.5} or
/// {"frame":42,"state":"failed","exit":7,"error":"..."}, and makes the frames in the order of the list. `command_for`
/// gives its arguments for a list of frames. If a signal ends it, the frame it was at has failed, and another process
/// makes the others.
void make_by_lines(const std::function<std::vector<std::string>(const std::vector<std::uint64_t>&)>& command_for,
                   const std::filesystem::path& folder, std::vector<std::uint64_t> frames,
                   const FrameListener& listener);

/// The same by POV-Ray, one process a frame, from scene/ into images/.
void make_by_povray(const Bundle& bundle, const Step& step, const Workplace& place,
                    const std::vector<std::uint64_t>& frames, const FrameListener& listener);

/// Removes POV-Ray's unfinished pictures of this process.
void remove_own_pictures(const std::filesystem::path& folder);
/// Removes whatever killed workers left unfinished. For a bundle that nobody works on any more.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace meniscus::farm
