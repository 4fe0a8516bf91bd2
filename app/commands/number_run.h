// SPDX-License-Identifier: BSD-3-Clause
// Computes the numbers that a command prints: of one molecule, or of each frame of a run.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/options/scene_options.h"
#include "app/reports/run_frames.h"
#include "app/reports/csv_tables.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/structure/structure.h"

namespace meniscus {

/// A structure and its frame.
struct NumberedStructure {
  Structure structure;
  Structure together;             ///< RunFrame::together; a single molecule has it, too
  std::optional<FrameNote> note;  ///< the frame; nothing for a single molecule
  std::uint64_t number = 0;       ///< number of the frame in the run, which names files
};

/// The structures of a molecule or a run, passed on by one loop: a molecule is a run of one frame.
class NumberRun {
 public:
  /// command: has resolved selections, and must outlive this object. Reads the molecule or opens the run, and prints
  /// what it read. Throws the errors of reading.
  explicit NumberRun(const SceneCommand& command);

  bool is_run() const { return frames_ != nullptr; }
  /// Returns the frames. The command must make a run.
  const FrameRun& frames() const { return *frames_; }
  /// Returns the structure of the molecule, or of the first frame of the run.
  const Structure& structure() const { return frames_ ? frames_->structure() : molecule_; }

  /// Does the part of the work that can run at the same time as other frames, perhaps on a thread of its own; the
  /// function that it returns runs in the order of the frames.
  using Worker = std::function<FinishFrame(NumberedStructure structure)>;
  /// Passes all structures to workers; each thread has a worker of its own, with a builder. At the end commit() keeps
  /// the results, even if some frames failed. Throws like run_frames; for a single molecule, the errors of the worker.
  void make(std::uint64_t bytes_per_atom,
            const std::function<Worker(const std::shared_ptr<MoleculeBuilder>& builder)>& make_worker,
            const std::function<void()>& commit);

 private:
  void make_molecule(const Worker& worker);
  void make_frames(std::vector<FrameWorker> workers, const std::function<void()>& commit);

  const SceneCommand& command_;
  std::unique_ptr<FrameRun> frames_;
  Structure molecule_;  ///< empty for a run
};

/// Returns the number of an atom of the structure that is the same in all frames of the run, and unique.
std::uint32_t lasting_number(const Structure& structure, std::uint32_t atom);

}  // namespace meniscus
