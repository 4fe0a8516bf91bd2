// SPDX-License-Identifier: BSD-3-Clause
// Makes the frames of a run, several at once, continues after one that fails, and reports all in their order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/options/scene_options.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"

namespace meniscus {

/// What came of a frame.
struct MadeFrame {
  std::vector<std::string> files;  ///< those written
  bool shows_nothing = false;      ///< it is a picture on which nothing is to be seen
  bool lacks_labels = false;       ///< it is a picture that has no room for them
};

/// What is left to do with a frame when those before it are done: on the thread that called run_frames.
using FinishFrame = std::function<MadeFrame()>;
/// Does what can be done with a frame while others are worked on, perhaps on a thread of its own.
using FrameWorker = std::function<FinishFrame(RunFrame frame)>;

/// Builders for as many frames as are worked on at once: as many as asked for (--jobs), else as the processor, the
/// frames and the memory allow. `frame_bytes`: what a frame takes until it is finished. One alone where surfaces are
/// made by GL, in `context` if there is one. Throws what MoleculeBuilder throws.
std::vector<std::shared_ptr<MoleculeBuilder>> frame_builders(const FrameRun& frames, const SceneCommand& command,
                                                             std::uint64_t frame_bytes,
                                                             const EglContext* context = nullptr);

/// Says how much of a frame's surface a volume map did not reach, of that frame of which it is the most.
void tell_beyond_map(const SceneCommand& command, std::span<const std::shared_ptr<MoleculeBuilder>> builders);

/// What a frame takes until it is finished, about: its surface and areas; and a mesh of half a pixel, with its file.
constexpr std::uint64_t kSurfaceBytesPerAtom = 8'000, kMeshBytesPerAtom = 150'000;

/// Has the frames of the chunk made by the workers, each by one of them, and finishes them in their order. The workers
/// share the cores; one that is alone works on the calling thread, with all of them. A frame that throws, in reading or
/// making, is told on stderr, and the run goes on; but OutputError and GpuError end it at once, as the next frame would
/// meet them too. Pictures that show nothing, or lack their labels, are told in one line for all of them. At the end
/// throws RunError: with the code of the first frame that failed, else with kExitIncomplete if the trajectory was cut
/// short and the run reaches its last whole frame.
void run_frames(FrameRun& frames, const SceneCommand& command, std::vector<FrameWorker> workers);

}  // namespace meniscus
