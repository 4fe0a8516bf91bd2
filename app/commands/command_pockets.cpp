// SPDX-License-Identifier: BSD-3-Clause
// `meniscus pockets`: finds pockets of a molecule or of the frames of a run, and writes their tables.
#include <iostream>

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/options/named_files.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/csv_tables.h"
#include "app/reports/notes.h"
#include "app/reports/pocket_report.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/pockets/pockets.h"
#include "core/queries/cavity_tracks.h"
#include "core/scene/frame_run.h"
#include "core/scene/scene_json.h"
#include "core/structure/selection/selection.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus {
namespace {

struct PocketsCommand : SceneCommand {
  PocketRequest pockets;
  Selection ligand = parse_selection("ligand");
  bool json = false;
  std::string csv;     ///< path; empty: none; "-": standard output
  std::string mesh;    ///< path; empty: none
  std::string figure;  ///< path of a scene; empty: none
  double mesh_tolerance = 0.02;
};

/// The memory of pockets; the large probe has more positions than there are atoms.
constexpr std::uint64_t kPocketBytesPerAtom = 10 * kSurfaceBytesPerAtom;

/// Returns, per atom of the structure, true if it is left out. Throws InputError if no atom remained.
std::vector<bool> taken_out(const PocketsCommand& command, const Structure& structure) {
  std::vector<bool> taken = command.ligand.evaluate(structure.atoms);
  if (std::ranges::find(taken, false) == taken.end())
    throw InputError(structure.file, 0,
                     "--ligand {1} takes out all {0} atoms, so nothing is left for pockets; name other atoms",
                     with_thousands(taken.size()), in_quotes(command.ligand.text()));
  return taken;
}

/// Returns the file of one molecule, or of one frame.
std::string path_of(const std::string& path, const NumberedStructure& numbered) {
  return numbered.note ? NumberedPath::parse(path)->at(numbered.number) : path;
}

/// Returns the command's scene for a single frame.
Scene scene_of(const Scene& requested, const std::optional<FrameNote>& note) {
  Scene scene = requested;
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
    removes_per_frame_ = run.is_run() && (run.frames().atoms_change() || command_.ligand.uses_positions());
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
          computer->compute(structure, removes_per_frame_ ? taken_out(command_, structure) : left_out_));
      return [this, numbered, pockets, computer] {
        return finish({numbered->structure, *pockets, computer->device()}, *numbered);
      };
    };
  }

  MadeFrame finish(const PocketReport& report, const NumberedStructure& numbered) {
    const std::optional<FrameNote>& note = numbered.note;
    if (!hinted_)
      for (const std::string& hint : pocket_hints(report))
        log_line(command_, note ? fmt::format("note: frame {}: {}", note->frame, hint) : "note: " + hint);
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
      return log_line(command_, fmt::format("note: frame {} has no pockets, and so no mesh", numbered.note->frame));
    made.files.push_back(path_of(command_.mesh, numbered));
    write_mesh_file(*mesh_format_of_path(command_.mesh), made.files.back(), command_.existing(),
                    pocket_file(pocket_mesh(report.pockets.found, command_.mesh_tolerance)));
  }

  void write_figure(const PocketReport& report, const NumberedStructure& numbered, MadeFrame& made) const {
    if (command_.figure.empty()) return;
    made.files.push_back(path_of(command_.figure, numbered));
    const Scene scene = scene_of(command_.scene, numbered.note);
    OutputFile file(made.files.back(), command_.existing());
    file.write(pocket_figure(report, scene_text_for(scene, made.files.back()), command_.ligand.text()));
    file.commit();
  }

  const PocketsCommand& command_;
  GrowingTable rows_;
  CavityTracks tracks_;
  bool removes_per_frame_ = false;  ///< true if the selection is evaluated in each frame
  std::vector<bool> left_out_;
  bool hinted_ = false;
  std::string held_;  ///< for a single molecule: printed once its table is complete
};

/// Prints the pockets of the molecule, or a line or a row for every frame as soon as it is finished. Tables
/// get their final names at the end, with the frames that could be made; there is one mesh and one scene per frame.
void print_pockets(const PocketsCommand& requested) {
  PocketsCommand command = requested;
  freeze_selections(command.scene, {&command.ligand});
  if (const std::string fault = scene_fault(command.scene); !fault.empty() && !command.figure.empty())
    throw UsageError("--figure: " + fault);
  PocketTables(command).make();
}

void check_mesh_path(const std::string& path) {
  const MeshFormat* const format = mesh_format_of_path(path);
  if (!format || format->solid || format->atoms)
    throw UsageError("--mesh {}: this format cannot hold several solids; choose one of {}", in_quotes(path),
                     mesh_format_words());
}

// Throws UsageError unless the path of a run has a place for the number of the frame.
void check_numbered(const char* option, const std::string& path) {
  if (path.empty() || NumberedPath::parse(path)) return;
  throw UsageError("{} {}: each frame needs a file of its own; put # where its number goes, as in {}", option,
                   in_quotes(path), in_quotes(numbered_name(path)));
}

void check_run(const PocketsCommand& command) {
  check_numbered("--mesh", command.mesh);
  check_numbered("--figure", command.figure);
  if (!command.csv.empty() && !command.scene.frames.only.empty())
    throw UsageError(
        "--csv needs all frames of the run, because pockets keep their numbers from frame to frame; leave --only out");
}

void check_request(const PocketsCommand& command) {
  if (const std::string fault = pocket_fault(command.pockets); !fault.empty()) throw UsageError(fault);
  if (command.scene.molecule.division.instances != InstanceMode::none)
    throw UsageError("--instances: pockets need the atoms of all copies; leave it out");
  if (command.json && command.csv == "-")
    throw UsageError("standard output holds one thing at a time: --json, or --csv -");
  if (!command.mesh.empty()) check_mesh_path(command.mesh);
  if (!command.figure.empty() && !command.figure.ends_with(".json"))
    throw UsageError("--figure {}: scenes are JSON; choose a name that ends in .json", in_quotes(command.figure));
  if (!command.figure.empty() && command.scene.molecule.file == "-")
    throw UsageError("--figure: a scene names its molecule's file, which standard input is not");
  if (!command.figure.empty() && command.scene.frames.interpolate > 1)
    throw UsageError("--figure: a scene cannot show a frame between two of the trajectory; leave --interpolate out");
  std::vector<std::string> paths{command.csv};
  if (command.scene.frames.is_requested())
    check_run(command);
  else
    paths.insert(paths.end(), {command.mesh, command.figure});
  // Files are opened before the work begins, so that errors come early, and removed again.
  for (const std::string& path : paths)
    if (!path.empty() && path != "-") check_output(path, command.existing());
}

TakenProperties pocket_properties() {
  return run_properties().with(
      {"surface.show", "-surface.kind", "-surface.verify"},
      {superposition_need({"report.csv_pockets", "report.json"}),
       {{"surface.show"}, {"report.pocket_figure"}, "it says what --figure shows; --select takes some of the atoms"},
       {{"pockets.tolerance"}, {"report.pocket_mesh"}, "it is that of a mesh; add --mesh FILE"}});
}

}  // namespace

void add_pockets(CLI::App& command) {
  describe(
      command,
      "  meniscus pockets 1hpv.pdb                         a table, and where the ligand lies\n"
      "  meniscus pockets 1hpv.pdb --json > pockets.json   one JSON object\n"
      "  meniscus pockets 1hpv.pdb --csv pockets.csv --mesh pockets.ply    rows, and solids in colours\n"
      "  meniscus pockets 1hpv.pdb --large-probe 6 --trim 0   shallower ones, too\n"
      "  meniscus pockets 1ake.cif --ligand 'resname AP5'  only these atoms are taken out\n"
      "  meniscus pockets adk.psf adk.dcd --superpose 'name CA' --csv run.csv   each pocket over time\n"
      "  meniscus pockets 1hpv.pdb --figure lining.json; meniscus lining.json -o lining.png   the atoms around, by "
      "rank",
      "A pocket is a connected region that the probe of --probe can fill, inside the solid that --large-probe rolls "
      "over\nand --trim below its surface. Large probes that touch the molecule close the mouths, so pockets are "
      "cavities of an\nexact surface, with volumes, areas and borders in closed form. A volume is too large by at most "
      "the area of the\nmouths times --mouth-tolerance (column `less up to`). A pocket without a mouth is a cavity, "
      "one with two or more a\ntunnel. Pockets are ranked by volume. Over frames a pocket keeps its number while "
      "probes at rest in it overlap.");
  auto declared = std::make_shared<DeclaredCommand<PocketsCommand>>(command, pocket_properties());
  PocketsCommand& state = declared->state;
  PropertyOptions options(command);
  options.add("pockets.large_probe", state.pockets.large_probe_radius);
  options.add("pockets.trim", state.pockets.trim);
  options.add("pockets.min_volume", state.pockets.min_volume);
  options.add("pockets.mouth_tolerance", state.pockets.tolerance);
  options.add_parsed("pockets.ligand",
                     [&state](const std::string& text) { state.ligand = parse_selection_option("--ligand", text); });
  options.add("report.json", state.json);
  options.add("report.csv_pockets", state.csv);
  options.add("report.pocket_mesh", state.mesh);
  options.add("report.pocket_figure", state.figure);
  options.add("pockets.tolerance", state.mesh_tolerance);
  command.callback([declared] {
    declared->options.take();
    PocketsCommand& requested = declared->state;
    requested.pockets.probe_radius = requested.scene.molecule.surface.probe_radius;
    requested.scene.molecule.reading.takes_ligands = true;  // --ligand says what is taken out
    check_request(requested);
    print_pockets(requested);
  });
}

}  // namespace meniscus
