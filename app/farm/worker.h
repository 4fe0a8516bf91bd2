// SPDX-License-Identifier: BSD-3-Clause
// Makes the missing frames of a part of a bundle: the one worker that every engine runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/farm/bundle.h"
#include "app/farm/claims.h"
#include "app/farm/makers.h"
#include "app/reports/run_progress.h"

namespace meniscus::farm {

/// Which part of the work is done.
struct Assignment {
  std::vector<std::string> steps;        ///< in order
  std::vector<std::uint64_t> frames;     ///< in order
  bool force = false;                    ///< frames that are there are made again
  bool alone = false;                    ///< no other worker is meant to make these: all are claimed at once
  Tries tries;                           ///< of a frame that fails
  double lease_seconds = kDefaultLease;  ///< others take over what a worker has that was not heard of for so long
};

/// Sizes, and of files up to 256 MiB or by reference checksums, of the bundle's inputs; checksums of all if `thorough`.
/// Throws InputError.
void check_inputs(const Bundle& bundle, const std::filesystem::path& folder, bool thorough);

/// Makes every frame of the assignment that has no record with good files and that no other worker makes (claims.h),
/// step by step, and writes a record of each; then waits for what others make, and takes over what they leave. A frame
/// that fails is recorded, too, and the others are made; then it is tried again, as often as the assignment says.
/// While the bundle is paused (pause.h), the worker has no frames and waits. Throws RunError with the code of the first
/// frame that failed, whatever the step and the worker; InputError for a bundle of another version of the program; what
/// check_inputs and make_frames throw.
void work(const Bundle& bundle, const Workplace& place, const Assignment& assignment, ProgressStyle progress);

}  // namespace meniscus::farm
