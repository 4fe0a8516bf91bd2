// SPDX-License-Identifier: BSD-3-Clause
// `meniscus surface`: computes the complete surface and prints its numbers: table, JSON object, CSV of atoms, residues.
#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "app/commands/command_table.h"
#include "app/commands/surface_command.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/program_error.h"
#include "core/base/output_file.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

bool is_stdout(const std::string& path) { return path == "-"; }

std::vector<std::string> tables_of(const SurfaceCommand& command) {
  std::vector<std::string> paths;
  for (const std::string& path : {command.series_csv, command.atom_csv, command.residue_csv, command.cavity_csv,
                                  command.gradient_csv, command.patch_csv})
    if (!path.empty()) paths.push_back(path);
  return paths;
}

TakenProperties surface_command_properties() {
  return run_properties().with(
      {"surface.patches", "surface.min_patch", "surface.by", "surface.cavities"},
      {{{"surface.patches"},
        [](const GivenScene& given) {
          return !given.scene.frames.asked() || given.any({"report.csv_patches", "report.json"});
        },
        "of a run, patches are written by --csv-patches FILE or --json; add one of them"},
       superposition_need({"report.csv_cavities", "report.gradients"}),
       {{"report.open_sky"}, {"report.csv_atoms"}, "it is a column of --csv FILE; add that"}});
}

}  // namespace

bool SurfaceCommand::prints_csv() const { return std::ranges::any_of(tables_of(*this), is_stdout); }

// Opens the outputs before the work begins, so that errors come early, and removes them again.
void check_outputs(const SurfaceCommand& command) {
  if (command.plot == "-" || (!command.plot.empty() && !command.plot.ends_with(".svg")))
    throw UsageError(
        fmt::format("--plot {}: plots are written as files whose names end in .svg", in_quotes(command.plot)));
  if (command.resumes) throw UsageError("--resume continues a table of many files; add --csv-summary FILE");
  std::vector<std::string> paths = tables_of(command);
  if (std::ranges::count_if(paths, is_stdout) + command.json > 1)
    throw UsageError(
        "standard output holds one thing at a time: --json, or one of --csv-series, --csv, --csv-residues, "
        "--csv-cavities, --csv-patches, --gradients with -");
  if (!command.plot.empty()) paths.push_back(command.plot);
  if (!command.gradient_csv.empty()) {
    const Division& division = command.scene.molecule.division;
    if (division.components || division.cavities != Cavities::keep || division.instances != InstanceMode::none)
      throw UsageError(
          "--gradients are of whole surfaces of atoms; leave --by component, --cavities and --instances out");
  }
  if (!command.cavity_csv.empty()) {
    const Division& division = command.scene.molecule.division;
    if (command.scene.molecule.surface.kind != SurfaceKind::ses || command.scene.molecule.surface.probe_radius == 0.0)
      throw UsageError(
          "--csv-cavities follows cavities of solvent-excluded surfaces; choose --surface ses and a probe");
    if (division.groups || division.components || division.cavities == Cavities::drop ||
        division.instances != InstanceMode::none)
      throw UsageError(
          "--csv-cavities follows the cavities of one surface; leave --by, --cavities drop and --instances out");
    if (!command.scene.frames.only.empty())
      throw UsageError(
          "--csv-cavities needs all frames of the run, because cavities keep their numbers from frame to frame; leave "
          "--only out");
  }
  if (!command.patch_csv.empty() && !command.scene.molecule.patches)
    throw UsageError("--csv-patches needs --patches EXPR, such as 'hydrophobicity > 1.5'");
  for (const std::string& path : paths)
    if (!is_stdout(path)) check_output(path, command.existing());
}

void add_surface(CLI::App& command) {
  describe(
      command,
      "  meniscus surface 1tii.pdb                         a table\n"
      "  meniscus surface 1tii.pdb --json > 1tii.json      one JSON object\n"
      "  meniscus surface 1tii.pdb --csv atoms.csv --csv-residues residues.csv   areas of each\n"
      "  meniscus surface 1tii.pdb --by chain              each chain as if it were alone\n"
      "  meniscus surface 1tii.pdb --select 'chain D' --context 'chain E'   area of D, and what E buries of it\n"
      "  meniscus surface 1tii.pdb --patches 'hydrophobicity > 1.5'   contiguous hydrophobic areas\n"
      "  meniscus surface 1tii.pdb --cavities only         cavities, and what is inside them\n"
      "  meniscus surface 1tii.pdb --gradients forces.csv  derivatives of areas and volumes by positions\n"
      "  meniscus surface 1tii.pdb --surface sas --csv -   solvent-accessible areas of atoms on standard output\n"
      "  meniscus surface balls.xyzr --surface vdw         van der Waals surface, radii of the file\n"
      "  meniscus surface adk.psf adk.dcd --csv-series run.csv --plot run.svg   one row per frame, curves\n"
      "  meniscus surface adk.psf adk.dcd --superpose 'name CA' --csv-cavities cavities.csv   each cavity over time\n"
      "  meniscus surface adk.psf adk.dcd --json                one line of JSON per frame\n"
      "  meniscus surface *.cif.gz --csv-summary all.csv        one row for each of many molecules",
      "The surface is that of the polymers and ligands of the first model, with the most occupied conformer of "
      "each\nresidue; water and free ions are left out. A line reports what was read, left out and used. Radii are "
      "Bondi's\n(`meniscus info` lists them), or the file's own (PQR, XYZR). The surface is closed and includes all "
      "cavities; areas\nand volumes are exact, in closed form. `volume` is that of the solid, without its cavities; "
      "the volume of a cavity is\npositive. The area of an atom is the part of the surface that has the atom's colour "
      "in pictures: its contact patch,\nand those parts of the patches around that are nearer to its contact with the "
      "probe than to any other contact.\nOver frames the tables of atoms and residues have rows for each frame. A "
      "cavity keeps its number while probes that\nrest in it, touching three atoms, overlap from one frame to the "
      "next.");
  auto declared = std::make_shared<DeclaredCommand<SurfaceCommand>>(command, surface_command_properties());
  SurfaceCommand& state = declared->state;
  state.scene.molecule.surface.timing = StageTiming::exact;  // each time is printed
  PropertyOptions options(command);
  options.add("report.json", state.json);
  options.add("report.csv_atoms", state.atom_csv);
  options.add("report.open_sky", state.open_sky);
  options.add("report.csv_residues", state.residue_csv);
  options.add("report.csv_series", state.series_csv);
  options.add("report.csv_cavities", state.cavity_csv);
  options.add("report.plot", state.plot);
  options.add("report.gradients", state.gradient_csv);
  options.add_selection("report.context", state.context);
  options.add("report.csv_patches", state.patch_csv);
  options.add("report.csv_summary", state.summary_csv);
  options.add("report.resume", state.resumes);
  command.callback([declared] {
    declared->options.take();
    // Parts of surfaces are cut out by planes, and rays meet patches within them.
    const Division& division = declared->state.scene.molecule.division;
    SurfaceCommand& asked = declared->state;
    MoleculeRequest& molecule = asked.scene.molecule;
    molecule.surface.drawn = division.components || division.cavities != Cavities::keep || asked.open_sky;
    molecule.surface.bordered =
        molecule.surface.drawn || molecule.patches || !asked.cavity_csv.empty() || !asked.gradient_csv.empty();
    asked.summary_csv.empty() ? print_surface(asked) : print_summary(asked);
  });
}

}  // namespace meniscus
