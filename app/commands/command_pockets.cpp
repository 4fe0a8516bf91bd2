// SPDX-License-Identifier: BSD-3-Clause
// `meniscus pockets`: finds pockets, tunnels and cavities, prints their numbers, and writes their solids as a mesh.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/commands/command_table.h"
#include "app/commands/pockets_command.h"
#include "app/options/numbered_path.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/program_error.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus {
namespace {

void check_mesh_path(const std::string& path) {
  const MeshFormat* const format = mesh_format_of_path(path);
  if (!format || format->solid || format->atoms)
    throw UsageError(fmt::format(
        "--mesh {}: the ending is not that of a format for pockets; choose one of {} that holds several solids",
        in_quotes(path), mesh_format_words()));
}

// Throws unless the path of a run has a place for the number of the frame.
void check_numbered(const char* option, const std::string& path) {
  if (path.empty() || NumberedPath::parse(path)) return;
  throw UsageError(fmt::format("{} {}: each frame needs a file of its own; put # where its number goes, as in {}",
                               option, in_quotes(path), in_quotes(numbered_name(path))));
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
    throw UsageError(
        fmt::format("--figure {}: scenes are JSON; choose a name that ends in .json", in_quotes(command.figure)));
  if (!command.figure.empty() && command.scene.molecule.file == "-")
    throw UsageError("--figure: a scene names its molecule's file, which standard input is not");
  if (!command.figure.empty() && command.scene.frames.interpolate > 1)
    throw UsageError(
        "--figure: a scene is of a frame of the trajectory, not of one in between; leave --interpolate out");
  std::vector<std::string> paths{command.csv};
  if (command.scene.frames.asked())
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
    PocketsCommand& asked = declared->state;
    asked.pockets.probe_radius = asked.scene.molecule.surface.probe_radius;
    check_request(asked);
    print_pockets(asked);
  });
}

}  // namespace meniscus
