// SPDX-License-Identifier: BSD-3-Clause
// `meniscus surface`: computes the complete surface and prints its numbers: table, JSON object, CSV of atoms, residues.
#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>

#include <unistd.h>

#include "app/reports/area_csv.h"
#include "app/commands/commands.h"
#include "app/reports/run_frames.h"
#include "core/scene/context_areas.h"
#include "core/scene/molecule.h"
#include "app/process/program_error.h"
#include "app/reports/notes.h"
#include "app/options/scene_file.h"
#include "app/options/molecule_options.h"
#include "app/options/frame_options.h"
#include "app/reports/surface_report.h"

namespace meniscus {
namespace {

struct SurfaceCommand {
  MoleculeOptions molecule;
  FrameOptions frames;
  bool json = false;
  std::string atom_csv, residue_csv;  ///< paths; empty: none; "-": standard output
  std::optional<Selection> context;
  bool force = false;
};

bool is_stdout(const std::string& path) { return path == "-"; }

// Whether the outputs can be written is known before the work begins; these vanish again.
void check_outputs(const SurfaceCommand& command, Existing existing) {
  if (is_stdout(command.atom_csv) + is_stdout(command.residue_csv) + command.json > 1)
    throw UsageError("standard output holds one thing at a time: --json, --csv - or --csv-residues -");
  if (!command.atom_csv.empty() && command.atom_csv == command.residue_csv)
    throw UsageError("--csv and --csv-residues need two different files");
  for (const std::string& path : {command.atom_csv, command.residue_csv})
    if (!path.empty() && !is_stdout(path)) OutputFile(path, existing);
}

void write(const std::string& path, const std::string& text, Existing existing) {
  if (path.empty()) return;
  if (is_stdout(path)) {
    std::cout << text;
    return;
  }
  OutputFile file(path, existing);
  file.write(text);
  file.commit();
}

// A line or a row for every frame, as soon as it is there.
void run_sequence(const SurfaceCommand& command) {
  if (command.context) throw UsageError("--context: not in a run of frames; leave one of them away");
  if (!command.atom_csv.empty() || !command.residue_csv.empty())
    throw UsageError("--csv: not in a run of frames; --json has the areas of chains");
  FrameRun frames(command.molecule, command.frames);
  tell_run(command.molecule, frames);
  if (!command.json) std::cout << report_row_header(command.molecule);
  FrameOptions options = command.frames;
  // On a terminal the rows themselves tell how far it is; a bar would run into them.
  if (options.progress == ProgressStyle::automatic && ::isatty(STDOUT_FILENO)) options.progress = ProgressStyle::none;
  const auto text_of = [&command](const Molecule& molecule, const FrameNote& note) {
    const auto columns = area_columns(molecule.structure, molecule.objects, command.molecule.surface.kind);
    const SurfaceReport report{molecule, command.molecule, columns, std::nullopt};
    return command.json ? report_json_line(report, note) : report_row(report, note);
  };
  std::vector<FrameWorker> workers;
  for (const auto& builder :
       frame_builders(frames, command.molecule, options, kSurfaceBytesPerAtom * frames.structure().atoms.size()))
    workers.push_back([&text_of, builder](RunFrame frame) -> FinishFrame {
      const std::string text = text_of(builder->build(std::move(frame.structure)), {frame.number, frame.time});
      return [text] {
        std::cout << text << std::flush;
        if (!std::cout) throw OutputError("standard output", "cannot be written");
        return MadeFrame{};
      };
    });
  run_frames(frames, command.molecule, options, std::move(workers));
}

void run(const SurfaceCommand& command) {
  if (command.frames.asked()) return run_sequence(command);
  const Existing existing = command.force ? Existing::replace : Existing::refuse;
  check_outputs(command, existing);
  const Molecule molecule = load_molecule(command.molecule);
  std::vector<AreaColumn> columns = area_columns(molecule.structure, molecule.objects, command.molecule.surface.kind);
  std::optional<ContextNote> context;
  if (command.context) {
    ContextAreas areas = context_areas(command.molecule, *command.context, molecule, columns);
    context = ContextNote{command.context->text(), areas.atoms};
    std::move(areas.columns.begin(), areas.columns.end(), std::back_inserter(columns));
  }
  if (!command.atom_csv.empty()) write(command.atom_csv, atom_csv(molecule.structure, columns), existing);
  if (!command.residue_csv.empty()) write(command.residue_csv, residue_csv(molecule.structure, columns), existing);
  if (is_stdout(command.atom_csv) || is_stdout(command.residue_csv)) return;
  const SurfaceReport report{molecule, command.molecule, columns, context};
  std::cout << (command.json ? report_json(report) : report_table(report));
}

}  // namespace

void add_surface(CLI::App& command) {
  describe(
      command, "Compute the surface; print area, volume, components, chains, and areas of atoms",
      "  meniscus surface 1tii.pdb                         a table\n"
      "  meniscus surface 1tii.pdb --json > 1tii.json      one JSON object\n"
      "  meniscus surface 1tii.pdb --csv atoms.csv --csv-residues residues.csv   areas of each\n"
      "  meniscus surface 1tii.pdb --by chain              each chain as if it were alone\n"
      "  meniscus surface 1tii.pdb --select 'chain D' --context 'chain E'   area of D, and what E buries of it\n"
      "  meniscus surface 1tii.pdb --cavities only         cavities, and what lies in them\n"
      "  meniscus surface 1tii.pdb --surface sas --csv -   solvent-accessible areas of atoms on standard output\n"
      "  meniscus surface balls.xyzr --surface vdw         van der Waals surface, radii of the file\n"
      "  meniscus surface adk.psf --trajectory adk.dcd --frames all --json      a line of JSON a frame",
      "Used are the polymers and ligands of the first model, of each residue the most occupied conformer; water and\n"
      "free ions are left out. What was read, left out and used is always said. Radii are Bondi's (`meniscus info`\n"
      "lists them), or the file's own (PQR, XYZR). The surface is complete, cavities too, and closed; areas and "
      "volumes\n"
      "are exact, in closed form. A cavity's volume is negative: it is missing from the solid. An atom's part of the\n"
      "surface is what has its colour in pictures: its contact patch, and of the patches around it what is nearer to\n"
      "its contact than to any other.");
  auto state = std::make_shared<SurfaceCommand>();
  state->molecule.surface.timing = StageTiming::exact;  // each is printed
  add_atom_options(command, state->molecule);
  add_surface_options(command, state->molecule);
  add_division_options(command, state->molecule);
  add_frame_options(command, state->frames);
  command.add_flag("--json", state->json, "Print one JSON object instead of a table");
  command.add_option("--csv", state->atom_csv, "Write areas of atoms, a row each; -: to standard output, nothing else")
      ->type_name("FILE");
  command.add_option("--csv-residues", state->residue_csv, "Write areas of residues, a row each; -: likewise")
      ->type_name("FILE");
  command
      .add_option_function<std::string>(
          "--context", [state](const std::string& text) { state->context = parse_selection_option("--context", text); },
          "Also the areas of --select in the presence of these atoms, and the difference: what is buried")
      ->type_name("EXPR");
  command.add_flag("--force", state->force, "Replace files that exist");
  add_scene_options(command);
  command.callback([state] {
    // Parts of surfaces are cut out by planes.
    const Division& division = state->molecule.division;
    state->molecule.surface.drawn = division.components || division.cavities != Cavities::keep;
    run(*state);
  });
}

}  // namespace meniscus
