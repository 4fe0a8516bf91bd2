// SPDX-License-Identifier: BSD-3-Clause
// A worker that users and every engine run: makes the missing frames of a bundle by the programs of its steps.
#pragma once

#include "app/farm/bundle.h"
#include "app/reports/run_frames.h"

namespace meniscus::farm {

/// Gets each frame once, as soon as it is done or has failed.
struct FrameListener {
  /// files: paths relative to the bundle.
  std::function<void(std::uint64_t frame, const std::vector<std::string>& files, double seconds)> done;
  std::function<void(std::uint64_t frame, int exit_code, const std::string& error)> failed;
};

/// The work on a bundle, and the means for it.
struct Order {
  std::filesystem::path folder;       ///< absolute path of the bundle
  std::vector<Step> steps;            ///< in order
  std::vector<std::uint64_t> frames;  ///< in the order of the run
  bool force = false;                 ///< true if existing frames are made again
  bool is_whole_run = false;          ///< true if other workers may have the same order
  std::vector<std::string> device;    ///< options of this program, which override the bundle's options
  int threads = 0;                    ///< threads of each process; 0: as many as the bundle says, else all
};

/// Makes frames by a program that reports each frame by a line of JSON, {"frame":42,"state":"done","files":[...],
/// "ms":1.5} or {"frame":42,"state":"failed","exit":7,"error":"..."}, in the order of the list. `command_for` returns
/// the words of its command line for a list of frames; if `alone`, it has to make one frame at a time.
void make_by_lines(
    const std::function<std::vector<std::string>(const std::vector<std::uint64_t>& frames, bool alone)>& command_for,
    const std::filesystem::path& folder, std::vector<std::uint64_t> frames, const FrameListener& listener);

/// Makes the frames of the order that are missing, and returns the seconds that they took. For a whole run, it begins
/// at a random place and checks repeatedly which frames exist, so that any number of independent workers can share a
/// run. Some frames may then be made twice, with the same bytes. A frame that fails is reported, and the others are
/// made. Throws RunError with the code of the first frame that failed; InputError for a bundle of another version of
/// the program; the errors of check_inputs and make_frames.
double work(const Bundle& bundle, const Order& order, ProgressStyle progress);

}  // namespace meniscus::farm
