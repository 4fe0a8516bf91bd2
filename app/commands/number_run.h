// SPDX-License-Identifier: BSD-3-Clause
// The numbers that a command prints: of one molecule, or of each frame of a run.
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

/// A structure on its way to its numbers.
struct NumberedStructure {
  Structure structure;
  Structure together;             ///< RunFrame::together, of a single molecule likewise
  std::optional<FrameNote> note;  ///< which frame it is; nothing: it is a single molecule
  std::uint64_t number = 0;       ///< of a frame, in the run, by which files are named
};

/// A molecule is a run of one frame: one loop makes the numbers of both.
class NumberRun {
 public:
  /// command: its selections settled; must live as long. Reads the molecule or opens the run, and says so. Throws what
  /// reading throws.
  explicit NumberRun(const SceneCommand& command);

  bool is_run() const { return frames_ != nullptr; }
  /// Of a run: must be one.
  const FrameRun& frames() const { return *frames_; }
  /// Of the molecule, or at the first frame of the run.
  const Structure& structure() const { return frames_ ? frames_->structure() : molecule_; }

  /// Does what can be done while others are worked on, perhaps on a thread of its own; what it returns is done in the
  /// order of the frames.
  using Worker = std::function<FinishFrame(NumberedStructure structure)>;
  /// Hands all structures to workers: each thread has one of its own, with a builder. At the end commit() keeps what
  /// was made, even if some frames failed. Throws as run_frames does; of one molecule what the worker throws.
  void make(std::uint64_t bytes_per_atom,
            const std::function<Worker(const std::shared_ptr<MoleculeBuilder>& builder)>& make_worker,
            const std::function<void()>& commit);

 private:
  void make_molecule(const Worker& worker);
  void make_frames(std::vector<FrameWorker> workers, const std::function<void()>& commit);

  const SceneCommand& command_;
  std::unique_ptr<FrameRun> frames_;
  Structure molecule_;  ///< unless it is a run
};

/// Of an atom of the structure a number that it has in all frames of the run, and no other atom has.
std::uint32_t lasting_number(const Structure& structure, std::uint32_t atom);

}  // namespace meniscus
