// SPDX-License-Identifier: BSD-3-Clause
// `meniscus pockets`: finds pockets, tunnels and cavities and prints their numbers; their solids as a mesh.
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/pockets_command.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/program_error.h"
#include "app/reports/notes.h"
#include "app/reports/pocket_report.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/mesh/mesh_objects.h"
#include "core/mesh/shape_mesh.h"
#include "core/scene/molecule_pockets.h"
#include "exporters/mesh_files/file_object.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus {
namespace {

const MeshFormat& format_of(const std::string& path) {
  const MeshFormat* const format = mesh_format_of_path(path);
  if (!format || format->solid || format->atoms)
    throw UsageError(
        fmt::format("--mesh {}: the ending names no format for pockets; there are {}, but those for one "
                    "solid or for atoms",
                    in_quotes(path), mesh_format_words()));
  return *format;
}

void check_request(const PocketsCommand& command) {
  if (const std::string fault = pocket_fault(command.pockets); !fault.empty()) throw UsageError(fault);
  if (command.scene.molecule.division.instances != InstanceMode::none)
    throw UsageError("--instances: pockets are between all atoms, those of copies too; leave it away");
  if (command.json && command.csv == "-")
    throw UsageError("standard output holds one thing at a time: --json, or --csv -");
  if (!command.mesh.empty()) format_of(command.mesh);
  if (!command.figure.empty() && !command.figure.ends_with(".json"))
    throw UsageError(
        fmt::format("--figure {}: scenes are JSON; choose a name that ends in .json", in_quotes(command.figure)));
  if (!command.figure.empty() && command.scene.molecule.file == "-")
    throw UsageError("--figure: a scene names its molecule's file, which standard input is not");
  std::vector<std::string> paths;
  for (const std::string& path : {command.csv, command.mesh, command.figure})
    if (!path.empty()) paths.push_back(path);
  if ((!command.mesh.empty() || !command.figure.empty()) && command.scene.frames.asked())
    throw UsageError("--mesh and --figure are of one molecule; leave them away where there are frames");
  // Whether the outputs can be written is known before the work begins; these vanish again.
  for (const std::string& path : paths)
    if (path != "-") check_output(path, command.existing());
}

void write_text(const std::string& path, const std::string& text, Existing existing) {
  if (path.empty()) return;
  OutputFile file(path, existing);
  file.write(text);
  file.commit();
}

void run_one(const PocketsCommand& command) {
  const Structure structure = read_and_tell(command);
  const std::vector<bool> left_out = taken_out(command, structure);
  PocketComputer computer(command.scene.molecule.surface, command.pockets);
  const MoleculePockets pockets = computer.compute(structure, left_out);
  const PocketReport report{structure, pockets, computer.device()};
  for (const std::string& hint : pocket_hints(report)) say(command, "note: " + hint);
  if (!command.mesh.empty())
    write_mesh_file(format_of(command.mesh), command.mesh, command.existing(),
                    pocket_file(pocket_mesh(pockets.found, command.mesh_tolerance)));
  if (!command.figure.empty())
    write_text(command.figure,
               pocket_figure(report, scene_text_beside(command.scene, command.figure), command.ligand.text()),
               command.existing());
  if (command.csv == "-") {
    std::cout << pocket_csv_header() << pocket_csv_rows(report);
    return;
  }
  write_text(command.csv, pocket_csv_header() + pocket_csv_rows(report), command.existing());
  std::cout << (command.json ? pocket_json(report) : pocket_table(report));
}

}  // namespace

std::vector<bool> taken_out(const PocketsCommand& command, const Structure& structure) {
  std::vector<bool> taken = command.ligand.evaluate(structure.atoms);
  if (std::ranges::find(taken, false) == taken.end())
    throw InputError(structure.file, 0,
                     fmt::format("all {} atoms are taken out by --ligand {}, so nothing is left for pockets to be "
                                 "between; name others, or none",
                                 with_thousands(taken.size()), in_quotes(command.ligand.text())));
  return taken;
}

void add_pockets(CLI::App& command) {
  describe(
      command,
      "  meniscus pockets 1hpv.pdb                         a table; the ligand's place is told\n"
      "  meniscus pockets 1hpv.pdb --json > pockets.json   one JSON object\n"
      "  meniscus pockets 1hpv.pdb --csv pockets.csv --mesh pockets.ply    rows, and solids in colours\n"
      "  meniscus pockets 1hpv.pdb --large-probe 6 --trim 0   shallower ones too\n"
      "  meniscus pockets 1ake.cif --ligand 'resname AP5'  only these atoms are taken out\n"
      "  meniscus pockets adk.psf adk.dcd --superpose 'name CA' --csv run.csv   each pocket through time\n"
      "  meniscus pockets 1hpv.pdb --figure lining.json; meniscus lining.json -o lining.png   the atoms around, by "
      "rank",
      "A pocket is a connected part of what a probe of --probe can fill of the solid that --large-probe rolls over, "
      "its\n"
      "surface lowered by --trim. Large probes that touch the molecule close the mouths; then pockets are cavities of\n"
      "an exact surface, and volume, areas and borders are in closed form. A volume is too large by at most the area "
      "of\n"
      "the mouths times --mouth-tolerance (`less up to`). Without a mouth it is a cavity, with two or more a tunnel.\n"
      "Ranked by volume. Over frames a pocket keeps its number while probes at rest in it overlap. docs/pockets.md.");
  auto declared = std::make_shared<DeclaredCommand<PocketsCommand>>(command, for_pockets);
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
    PocketsCommand& asked = declared->state;
    asked.pockets.probe_radius = asked.scene.molecule.surface.probe_radius;
    check_request(asked);
    if (asked.scene.frames.asked()) return pockets_frames(asked);
    run_one(asked);
  });
}

}  // namespace meniscus
