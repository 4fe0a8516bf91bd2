// SPDX-License-Identifier: BSD-3-Clause
// The run of frames of `meniscus pockets`: pockets of each, followed from one to the next.
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "app/commands/pockets_command.h"
#include "app/process/program_error.h"
#include "app/reports/csv_tables.h"
#include "app/reports/notes.h"
#include "app/reports/pocket_report.h"
#include "app/reports/run_frames.h"
#include "core/queries/cavity_tracks.h"
#include "core/scene/molecule_pockets.h"
#include "core/scene/settled_selections.h"

namespace meniscus {
namespace {

/// Places of the large probe are more than atoms.
constexpr std::uint64_t kPocketBytesPerAtom = 10 * kSurfaceBytesPerAtom;

class PocketFrames {
 public:
  explicit PocketFrames(const PocketsCommand& command)
      : command_(command), rows_(command.csv, command.existing()), tracks_(command.pockets.probe_radius) {}

  void run() {
    FrameRun frames(command_.scene.molecule, command_.scene.frames);
    tell_run(command_, frames);
    takes_out_anew_ = frames.atoms_change() || command_.ligand.uses_positions();
    left_out_ = taken_out(command_, frames.structure());
    if (!command_.json && command_.csv != "-") std::cout << pocket_row_header();
    SceneCommand command = command_;
    // On a terminal the rows themselves tell how far it is; a bar would run into them.
    ProgressStyle& progress = command.reporting.progress;
    if (progress == ProgressStyle::automatic && ::isatty(STDOUT_FILENO)) progress = ProgressStyle::none;
    std::vector<FrameWorker> workers;
    const std::size_t count =
        frame_builders(frames, command, kPocketBytesPerAtom * frames.structure().atoms.size()).size();
    while (workers.size() < count) workers.push_back(worker());
    try {
      run_frames(frames, command, std::move(workers));
    } catch (const RunError&) {
      rows_.commit();  // of a run that misses some frames the others are kept; the exit code tells
      throw;
    }
    rows_.commit();
  }

 private:
  FrameWorker worker() {
    const auto computer = std::make_shared<PocketComputer>(command_.scene.molecule.surface, command_.pockets);
    return [this, computer](RunFrame frame) -> FinishFrame {
      auto pockets = std::make_shared<MoleculePockets>(
          computer->compute(frame.structure, takes_out_anew_ ? taken_out(command_, frame.structure) : left_out_));
      const auto structure = std::make_shared<Structure>(std::move(frame.structure));
      const FrameNote note{frame.source, frame.time};
      return [this, pockets, structure, note, computer] {
        return finish({*structure, *pockets, computer->device()}, note);
      };
    };
  }

  MadeFrame finish(const PocketReport& report, const FrameNote& note) {
    if (!hinted_)
      for (const std::string& hint : pocket_hints(report))
        say(command_, fmt::format("note: frame {}: {}", note.frame, hint));
    hinted_ = true;
    if (command_.csv != "-") print_now(command_.json ? pocket_json_line(report, note) : pocket_row(report, note));
    std::vector<Cavity> cavities;
    for (const Pocket& pocket : report.pockets.found.pockets) {
      cavities.push_back(pocket.cavity);
      for (std::uint32_t& atom : cavities.back().atoms) atom = report.structure.atoms[atom].index;
    }
    rows_.write(pocket_series_header(), pocket_series_rows(report, note, tracks_.follow(cavities)));
    return {};
  }

  const PocketsCommand& command_;
  GrowingTable rows_;
  CavityTracks tracks_;
  bool takes_out_anew_ = false;  ///< in each frame
  std::vector<bool> left_out_;
  bool hinted_ = false;
};

}  // namespace

void pockets_frames(const PocketsCommand& asked) {
  PocketsCommand command = asked;
  if (!command.csv.empty() && !command.scene.frames.only.empty())
    throw UsageError(
        "--csv needs all frames of the run, as numbers of pockets go on from one to the next; leave "
        "--only away");
  settle_selections(command.scene.molecule, command.scene.frames, {.of_atoms = {&command.ligand}});
  PocketFrames(command).run();
}

}  // namespace meniscus
