// SPDX-License-Identifier: BSD-3-Clause
// Makes the frames of a run on several threads, and reports the progress.
#pragma once

#include "app/options/scene_options.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"

namespace meniscus {

/// Reports the progress of one run; for one thread.
class RunProgress {
 public:
  /// at_once: number of frames at work at the same time. word: the word for a frame here.
  RunProgress(ProgressStyle style, bool quiet, std::uint64_t frames, std::size_t at_once = 1,
              const char* word = "frame");

  /// Reports a finished frame. empty: its picture shows nothing.
  void done(std::uint64_t frame, const std::vector<std::string>& files, double milliseconds, bool empty = false);
  void failed(std::uint64_t frame, int exit_code, const std::string& message);
  /// Must be called after the last frame, in case of failure, too.
  void end();

 private:
  void advance();

  ProgressStyle style_;
  const std::string word_;
  std::uint64_t total_, done_ = 0, failed_ = 0;
  int last_tenth_ = -1;
  std::chrono::steady_clock::time_point begin_;
};

/// The result of a frame.
struct MadeFrame {
  std::vector<std::string> files;  ///< the files that were written
  bool shows_nothing = false;      ///< true for a picture that shows nothing
  bool lacks_labels = false;       ///< true for a picture without room for its labels
};

/// The rest of the work on a frame, which runs after all previous frames, on the thread that called run_frames.
using FinishFrame = std::function<MadeFrame()>;
/// Does the part of the work on a frame that can run at the same time as other frames, perhaps on a thread of its own.
using FrameWorker = std::function<FinishFrame(RunFrame frame)>;

/// Returns one builder per frame at work: as many as requested (--jobs), else as many as the processor, the frames and
/// the memory allow. `frame_bytes`: the memory of a frame until it is finished. There is only one if GL makes the
/// surfaces, in `context` if that is given. Throws like MoleculeBuilder.
std::vector<std::shared_ptr<MoleculeBuilder>> frame_builders(const FrameRun& frames, const SceneCommand& command,
                                                             std::uint64_t frame_bytes,
                                                             const EglContext* context = nullptr);

/// Prints the largest share of a frame's surface outside a volume map.
void warn_beyond_map(const SceneCommand& command, std::span<const std::shared_ptr<MoleculeBuilder>> builders);

/// The approximate memory of a frame until it is finished: surface and areas; mesh of half a pixel and its file.
constexpr std::uint64_t kSurfaceBytesPerAtom = 8'000, kMeshBytesPerAtom = 150'000;

/// Makes the frames of the chunk, each by one worker, and finishes them in order. The workers share the cores; a single
/// worker uses all of them on the calling thread. If reading or making a frame throws, the error is printed on standard
/// error, and the run continues; but OutputError and GpuError end it at once, because the next frame would meet them,
/// too. Pictures that show nothing, or lack their labels, are reported together in one line. At the end it throws
/// RunError: with the code of the first frame that failed, else with kExitIncomplete if the trajectory was cut short
/// and the run reaches its last complete frame.
void run_frames(FrameRun& frames, const SceneCommand& command, std::vector<FrameWorker> workers);

}  // namespace meniscus
