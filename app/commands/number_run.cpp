// SPDX-License-Identifier: BSD-3-Clause
// Passes one structure, or the structures of all frames, to the code that computes their numbers.
#include "app/commands/number_run.h"

#include <utility>
#include <vector>

#include <unistd.h>

#include "app/process/program_error.h"
#include "app/reports/notes.h"
#include "core/scene/context_areas.h"

namespace meniscus {

NumberRun::NumberRun(const SceneCommand& command) : command_(command) {
  if (!command.scene.frames.asked()) {
    molecule_ = read_and_tell(command);
    return;
  }
  frames_ = std::make_unique<FrameRun>(command.scene.molecule, command.scene.frames);
  tell_run(command, *frames_);
}

void NumberRun::make(std::uint64_t bytes_per_atom,
                     const std::function<Worker(const std::shared_ptr<MoleculeBuilder>&)>& make_worker,
                     const std::function<void()>& commit) {
  if (!frames_) {
    make_molecule(make_worker(std::make_shared<MoleculeBuilder>(command_.scene.molecule)));
    return commit();
  }
  std::vector<FrameWorker> workers;
  for (const auto& builder : frame_builders(*frames_, command_, bytes_per_atom * frames_->structure().atoms.size()))
    workers.push_back([worker = make_worker(builder)](RunFrame frame) {
      return worker(
          {std::move(frame.structure), std::move(frame.together), FrameNote{frame.source, frame.time}, frame.number});
    });
  make_frames(std::move(workers), commit);
}

void NumberRun::make_molecule(const Worker& worker) {
  NumberedStructure numbered{std::move(molecule_), {}, {}, 0};
  const MoleculeRequest& molecule = command_.scene.molecule;
  if (const std::optional<Selection>& context = command_.scene.frames.context)
    numbered.together = read_molecule(with_context(molecule, *context));
  worker(std::move(numbered))();
}

void NumberRun::make_frames(std::vector<FrameWorker> workers, const std::function<void()>& commit) {
  SceneCommand command = command_;
  // On a terminal the rows show the progress; a bar would collide with them.
  ProgressStyle& progress = command.reporting.progress;
  if (progress == ProgressStyle::automatic && ::isatty(STDOUT_FILENO)) progress = ProgressStyle::none;
  try {
    run_frames(*frames_, command, std::move(workers));
  } catch (const RunError&) {
    commit();  // a run with failed frames keeps the others; the exit code reports it
    throw;
  }
  commit();
}

std::uint32_t lasting_number(const Structure& structure, std::uint32_t atom) {
  const Atom& named = structure.atoms[atom];
  return named.copy * static_cast<std::uint32_t>(structure.topology->atoms.size()) + named.index;
}

}  // namespace meniscus
