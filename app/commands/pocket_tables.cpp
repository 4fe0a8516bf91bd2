// SPDX-License-Identifier: BSD-3-Clause
// Prints and writes the results of `meniscus pockets`: pockets of a molecule, or of each frame, tracked from one frame
// to the next.
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/commands/number_run.h"
#include "app/commands/pockets_command.h"
#include "app/options/numbered_path.h"
#include "app/process/program_error.h"
#include "app/reports/csv_tables.h"
#include "app/reports/notes.h"
#include "app/reports/pocket_report.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/queries/cavity_tracks.h"
#include "core/scene/molecule_pockets.h"
#include "core/scene/scene_paths.h"
#include "core/scene/settled_selections.h"
#include "exporters/mesh_files/mesh_file_maker.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus {
namespace {

/// There are more positions of the large probe than atoms.
constexpr std::uint64_t kPocketBytesPerAtom = 10 * kSurfaceBytesPerAtom;

/// Returns, per atom of the structure, true if it is left out. Throws InputError if no atom remained.
std::vector<bool> taken_out(const PocketsCommand& command, const Structure& structure) {
  std::vector<bool> taken = command.ligand.evaluate(structure.atoms);
  if (std::ranges::find(taken, false) == taken.end())
    throw InputError(structure.file, 0,
                     fmt::format("all {} atoms are taken out by --ligand {}, so nothing is left for pockets to be "
                                 "between; name others, or none",
                                 with_thousands(taken.size()), in_quotes(command.ligand.text())));
  return taken;
}

/// Returns the file of one molecule, or of one frame.
std::string path_of(const std::string& path, const NumberedStructure& numbered) {
  return numbered.note ? NumberedPath::parse(path)->at(numbered.number) : path;
}

/// Returns the command's scene for a single frame.
Scene scene_of(const Scene& asked, const std::optional<FrameNote>& note) {
  Scene scene = asked;
  if (!note) return scene;
  RunRequest& frames = scene.frames;
  frames.frames = std::to_string(note->frame);
  frames.stride = frames.repeat = 1;
  for (std::string* const bound : {&frames.begin, &frames.end, &frames.only}) bound->clear();
  return scene;
}

class PocketTables {
 public:
  explicit PocketTables(const PocketsCommand& command)
      : command_(command), rows_(command.csv, command.existing()), tracks_(command.pockets.probe_radius) {}

  void make() {
    NumberRun run(command_);
    takes_out_anew_ = run.is_run() && (run.frames().atoms_change() || command_.ligand.uses_positions());
    left_out_ = taken_out(command_, run.structure());
    if (run.is_run() && !command_.json && command_.csv != "-") std::cout << pocket_row_header();
    run.make(
        kPocketBytesPerAtom, [this](const auto&) { return worker(); },
        [this] {
          rows_.commit();
          print_now(held_);
        });
  }

 private:
  NumberRun::Worker worker() {
    const auto computer = std::make_shared<PocketComputer>(command_.scene.molecule.surface, command_.pockets);
    return [this, computer](NumberedStructure given) -> FinishFrame {
      const auto numbered = std::make_shared<NumberedStructure>(std::move(given));
      const Structure& structure = numbered->structure;
      const auto pockets = std::make_shared<MoleculePockets>(
          computer->compute(structure, takes_out_anew_ ? taken_out(command_, structure) : left_out_));
      return [this, numbered, pockets, computer] {
        return finish({numbered->structure, *pockets, computer->device()}, *numbered);
      };
    };
  }

  MadeFrame finish(const PocketReport& report, const NumberedStructure& numbered) {
    const std::optional<FrameNote>& note = numbered.note;
    if (!hinted_)
      for (const std::string& hint : pocket_hints(report))
        say(command_, note ? fmt::format("note: frame {}: {}", note->frame, hint) : "note: " + hint);
    hinted_ = true;
    MadeFrame made;
    write_mesh(report, numbered, made);
    write_figure(report, numbered, made);
    if (command_.csv != "-" && note) print_now(printed(report, note));
    if (command_.csv != "-" && !note) held_ = printed(report, note);
    if (note)
      rows_.write(pocket_series_header(), pocket_series_rows(report, *note, tracks_.follow(cavities_of(report))));
    else
      rows_.write(pocket_csv_header(), pocket_csv_rows(report));
    return made;
  }

  std::string printed(const PocketReport& report, const std::optional<FrameNote>& note) const {
    if (!note) return command_.json ? pocket_json(report) : pocket_table(report);
    return command_.json ? pocket_json_line(report, *note) : pocket_row(report, *note);
  }

  static std::vector<Cavity> cavities_of(const PocketReport& report) {
    std::vector<Cavity> cavities;
    for (const Pocket& pocket : report.pockets.found.pockets) {
      cavities.push_back(pocket.cavity);
      for (std::uint32_t& atom : cavities.back().atoms) atom = lasting_number(report.structure, atom);
    }
    return cavities;
  }

  void write_mesh(const PocketReport& report, const NumberedStructure& numbered, MadeFrame& made) const {
    if (command_.mesh.empty()) return;
    if (numbered.note && report.pockets.found.pockets.empty())
      return say(command_, fmt::format("note: frame {} has no pockets, and so no mesh", numbered.note->frame));
    made.files.push_back(path_of(command_.mesh, numbered));
    write_mesh_file(*mesh_format_of_path(command_.mesh), made.files.back(), command_.existing(),
                    pocket_file(pocket_mesh(report.pockets.found, command_.mesh_tolerance)));
  }

  void write_figure(const PocketReport& report, const NumberedStructure& numbered, MadeFrame& made) const {
    if (command_.figure.empty()) return;
    made.files.push_back(path_of(command_.figure, numbered));
    const Scene scene = scene_of(command_.scene, numbered.note);
    OutputFile file(made.files.back(), command_.existing());
    file.write(pocket_figure(report, scene_text_beside(scene, made.files.back()), command_.ligand.text()));
    file.commit();
  }

  const PocketsCommand& command_;
  GrowingTable rows_;
  CavityTracks tracks_;
  bool takes_out_anew_ = false;  ///< true if the selection is evaluated in each frame
  std::vector<bool> left_out_;
  bool hinted_ = false;
  std::string held_;  ///< for a single molecule: printed once its table is complete
};

}  // namespace

void print_pockets(const PocketsCommand& asked) {
  PocketsCommand command = asked;
  settle_selections(command.scene, {&command.ligand});
  if (const std::string fault = scene_fault(command.scene); !fault.empty() && !command.figure.empty())
    throw UsageError("--figure: " + fault);
  PocketTables(command).make();
}

}  // namespace meniscus
