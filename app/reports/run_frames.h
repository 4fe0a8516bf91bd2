// SPDX-License-Identifier: BSD-3-Clause
// Makes the frames of a run one after another, goes on after one that fails, and tells it all.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/options/frame_options.h"
#include "app/options/molecule_options.h"
#include "core/scene/frame_run.h"

namespace meniscus {

/// What came of a frame.
struct MadeFrame {
  std::vector<std::string> files;  ///< those written
  bool shows_nothing = false;      ///< it is a picture on which nothing is to be seen
};

/// Calls `make` for each frame of the chunk. A frame that throws, in reading or making, is
/// told on stderr, and the run goes on; but OutputError and GpuError end it at once, as the next frame would meet them
/// too. Pictures that show nothing are told in one line for all of them. At the end throws RunError: with the code of
/// the first frame that failed, else with kExitIncomplete if the trajectory was cut short and the run reaches its last
/// whole frame.
void run_frames(FrameRun& frames, const MoleculeOptions& molecule, const FrameOptions& options,
                const std::function<MadeFrame(const RunFrame& frame)>& make);

}  // namespace meniscus
