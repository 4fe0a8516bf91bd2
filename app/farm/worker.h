// SPDX-License-Identifier: BSD-3-Clause
// Makes the missing frames of a bundle: the one worker that people and every engine run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "app/farm/bundle.h"
#include "app/farm/make_frames.h"
#include "app/reports/run_progress.h"

namespace meniscus::farm {

/// Which part of the work is done.
struct Share {
  std::vector<Step> steps;            ///< in order
  std::vector<std::uint64_t> frames;  ///< in the order of the run
  bool force = false;                 ///< frames that are there are made again
  bool is_whole_run = false;          ///< others may be at it, too
};

/// Returns those frames, in order, that have no result of the step.
std::vector<std::uint64_t> missing_frames(const Bundle& bundle, const std::filesystem::path& folder, Step step,
                                          const std::vector<std::uint64_t>& frames);

/// Checks the sizes of the bundle's inputs, and the checksums of those up to 256 MiB; `thorough`: of all. Throws
/// InputError.
void check_inputs(const Bundle& bundle, const std::filesystem::path& folder, bool thorough);

/// Makes the frames of the share that are missing, and returns the seconds that they took. Of a whole run, it begins at
/// a place of its own and looks again and again which frames are there, so that any number of workers that do not know
/// of each other share a run; some frames are then made twice, with the same bytes. A frame that fails is told, and the
/// others are made. Throws RunError with the code of the first frame that failed; InputError for a bundle of another
/// version of the program; what check_inputs and make_frames throw.
double work(const Bundle& bundle, const Workplace& place, const Share& share, ProgressStyle progress);

}  // namespace meniscus::farm
