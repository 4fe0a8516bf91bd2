// SPDX-License-Identifier: BSD-3-Clause
// The loop over frames.
#include "app/reports/run_frames.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include <fmt/format.h>

#include "app/process/program_error.h"
#include "app/reports/run_progress.h"
#include "app/reports/notes.h"
#include "app/options/molecule_options.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

bool ends_the_run(const std::exception& error) {
  const ExitCode code = exit_code_of(error);
  return code == kExitOutput || code == kExitGpu || code == kExitUsage || code == kExitInternal;
}

/// The first frame that failed, and how many did.
struct Failures {
  std::uint64_t count = 0, frame = 0;
  ExitCode code = kExitOk;
  std::string message;
};

/// The first picture on which nothing is to be seen, and how many there are.
struct EmptyPictures {
  std::uint64_t count = 0, first = 0;

  std::string sentence() const {
    return fmt::format(
        "warning: {} of the pictures {} nothing (first: frame {}): no ray meets a part of the surface that --show "
        "leaves; where does the camera look?",
        with_thousands(count), count == 1 ? "shows" : "show", first);
  }
};

}  // namespace

void run_frames(FrameRun& frames, const MoleculeOptions& molecule, const FrameOptions& options,
                const std::function<MadeFrame(const RunFrame&)>& make) {
  RunProgress progress(options.progress, molecule.quiet, frames.chunk().size());
  Failures failures;
  EmptyPictures empty;
  for (std::size_t n = 0; n < frames.chunk().size(); ++n) {
    const std::uint64_t number = frames.upcoming();
    const auto begin = std::chrono::steady_clock::now();
    try {
      const std::optional<RunFrame> frame = frames.next();
      const MadeFrame made = make(*frame);
      const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
      progress.done(number, made.files, elapsed.count(), made.shows_nothing);
      if (made.shows_nothing && empty.count++ == 0) empty.first = number;
    } catch (const std::exception& error) {
      if (ends_the_run(error)) throw;
      if (failures.count++ == 0) failures = {1, number, exit_code_of(error), error.what()};
      progress.failed(number, exit_code_of(error), error.what());
    }
  }
  progress.end();
  if (empty.count > 0) say(molecule, empty.sentence());
  if (failures.count > 0) {
    throw RunError(failures.code,
                   fmt::format("{} of {} frames failed; the first, frame {}: {}", with_thousands(failures.count),
                               with_thousands(frames.chunk().size()), failures.frame, failures.message));
  }
  const Trajectory& trajectory = frames.trajectory();
  const bool reaches_end = std::ranges::find(frames.chunk(), trajectory.frame_count() - 1) != frames.chunk().end();
  if (!trajectory.cut_short().empty() && reaches_end) {
    throw RunError(kExitIncomplete, fmt::format("{}: {}; every whole frame asked for is done", trajectory.path(),
                                                trajectory.cut_short()));
  }
}

}  // namespace meniscus
