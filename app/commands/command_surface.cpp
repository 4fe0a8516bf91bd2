// SPDX-License-Identifier: BSD-3-Clause
// `meniscus surface`: computes the complete surface and writes its numbers.

#include <iostream>
#include <iterator>

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/commands/surface_command.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/csv_tables.h"
#include "app/reports/notes.h"
#include "app/reports/surface_report.h"
#include "core/base/constants.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/tessellate.h"
#include "core/queries/cavity_tracks.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"

namespace meniscus {
namespace {

/// The numbers of a molecule, or of a frame before its position among the others matters.
struct SurfaceNumbers {
  std::vector<SeriesValue> values;
  std::string printed, atom_header, atoms, residue_header, residues, gradient_header, gradients, patches;
  std::vector<Cavity> cavities;
  std::vector<std::string> lining;  ///< residues that line each cavity
};

/// Returns the first cells of a frame's rows; empty for a single molecule.
std::string prefix_of(const std::optional<FrameNote>& note) { return note ? frame_cells(*note) + "," : std::string(); }

/// Returns the open sky of each atom; in several copies, each atom is seen past its own object.
AreaColumn open_sky(const Molecule& molecule) {
  constexpr double kTolerance = 0.3;  // Å: enough points for a mean
  AreaColumn column{"open_sky", std::vector<double>(molecule.structure.atoms.size(), 0.0), 0.0};
  for (const SurfaceObject& object : molecule.objects) {
    const TriangleMesh mesh = tessellate(object.surface, {.tolerance = kTolerance});
    const std::vector<double> means = atom_open_sky(object.surface, mesh);
    for (std::size_t n = 0; n < means.size(); ++n) column.values[object.atom[n]] = means[n];
  }
  return column;
}

class SurfaceTables {
 public:
  explicit SurfaceTables(const SurfaceCommand& command)
      : command_(command),
        series_(command.series_csv, command.existing()),
        atoms_(command.atom_csv, command.existing()),
        residues_(command.residue_csv, command.existing()),
        gradients_(command.gradient_csv, command.existing()),
        cavities_(command.cavity_csv, command.existing()),
        patches_(command.patch_csv, command.existing()),
        tracks_(command.scene.molecule.surface.probe_radius) {
    if (!command.plot.empty()) plot_.emplace(command.plot, command.existing());
  }

  void make() {
    NumberRun run(command_);
    if (run.is_run() && !command_.json && !command_.prints_csv())
      std::cout << report_row_header(command_.scene.molecule);
    run.make(
        kSurfaceBytesPerAtom, [this](const auto& builder) { return worker(builder); }, [this] { commit(); });
  }

 private:
  NumberRun::Worker worker(const std::shared_ptr<MoleculeBuilder>& builder) {
    return [this, builder](NumberedStructure numbered) -> FinishFrame {
      const std::optional<FrameNote> note = numbered.note;
      const Molecule molecule = builder->build(std::move(numbered.structure));
      if (!note) log_surface(command_, molecule);
      auto numbers = std::make_shared<SurfaceNumbers>(numbers_of(molecule, numbered.together, note, *builder));
      return [this, numbers, note] { return finish(*numbers, note); };
    };
  }

  SurfaceNumbers numbers_of(const Molecule& molecule, const Structure& together, const std::optional<FrameNote>& note,
                            MoleculeBuilder& builder) const {
    SurfaceNumbers numbers;
    const SurfaceKind kind = command_.scene.molecule.surface.kind;
    std::vector<AreaColumn> columns;
    if (command_.context || atoms_.is_wanted() || residues_.is_wanted())
      columns = area_columns(molecule.structure, molecule.objects, kind);
    else if (note && !command_.json)
      columns = area_totals(molecule.objects, kind);
    else
      columns = area_sums(molecule.structure, molecule.objects, kind, group_atoms(molecule.structure, Grouping::chain));
    std::optional<ContextNote> context;
    if (command_.context) {
      ContextAreas areas = context_areas(command_.scene.molecule, together, molecule, columns, builder.computer());
      context = ContextNote{command_.context->text(), areas.atoms};
      std::move(areas.columns.begin(), areas.columns.end(), std::back_inserter(columns));
    }
    std::optional<PatchReport> patches;
    const MoleculeRequest& request = command_.scene.molecule;
    if (request.patches) patches = patch_report(molecule, *request.patches, request.least_patch);
    if (!command_.prints_csv())
      numbers.printed =
          printed({molecule, command_.scene.molecule, columns, context, patches, command_.reporting.verbose}, note);
    if (series_.is_wanted() || plot_) numbers.values = series_values(molecule, columns);
    const std::string prefix = prefix_of(note), more_columns = note ? std::string(kFrameColumns) + "," : std::string();
    if (residues_.is_wanted()) {
      numbers.residue_header = more_columns + residue_csv_header(columns, request.surface.probe_radius);
      numbers.residues = residue_csv_rows(molecule.structure, columns, request.surface.probe_radius, prefix);
    }
    if (patches_.is_wanted()) numbers.patches = patch_csv_rows(*patches, molecule.structure, prefix);
    if (atoms_.is_wanted()) {
      if (command_.open_sky) columns.push_back(open_sky(molecule));
      numbers.atom_header = more_columns + atom_csv_header(columns);
      numbers.atoms = atom_csv_rows(molecule.structure, columns, prefix);
    }
    if (gradients_.is_wanted()) {
      const std::vector<GradientColumn> gradients = gradient_columns(molecule.structure, molecule.objects, kind);
      numbers.gradient_header = more_columns + gradient_csv_header(gradients);
      numbers.gradients = gradient_csv_rows(molecule.structure, gradients, prefix);
    }
    if (cavities_.is_wanted()) {
      const SurfaceObject& object = molecule.objects.front();
      numbers.cavities = cavities_of(object.surface);
      for (Cavity& cavity : numbers.cavities) {
        numbers.lining.push_back(lining_residues(molecule.structure, object, cavity));
        for (std::uint32_t& atom : cavity.atoms) atom = lasting_number(molecule.structure, object.atom[atom]);
      }
    }
    return numbers;
  }

  std::string printed(const SurfaceReport& report, const std::optional<FrameNote>& note) const {
    if (!note) return command_.json ? report_json(report) : report_table(report);
    return command_.json ? report_json_line(report, *note) : report_row(report, *note);
  }

  MadeFrame finish(SurfaceNumbers& numbers, const std::optional<FrameNote>& note) {
    if (note) print_now(numbers.printed);
    if (!note) held_ = numbers.printed;
    atoms_.write(numbers.atom_header, numbers.atoms);
    residues_.write(numbers.residue_header, numbers.residues);
    gradients_.write(numbers.gradient_header, numbers.gradients);
    patches_.write((note ? std::string(kFrameColumns) + "," : std::string()) + patch_csv_header(), numbers.patches);
    if (note) follow(numbers, *note);
    return {};
  }

  /// Updates the state that continues from one frame to the next.
  void follow(SurfaceNumbers& numbers, const FrameNote& note) {
    if (series_.is_wanted()) series_.write(series_csv_header(numbers.values), series_csv_row(numbers.values, note));
    if (plot_) plot_frame(numbers.values, note);
    if (!cavities_.is_wanted()) return;
    std::string rows;
    for (const CavityStep& step : tracks_.follow(numbers.cavities)) {
      const bool is_there = step.cavity != kNone;
      rows += cavity_csv_row(note, step, is_there ? &numbers.cavities[step.cavity] : nullptr,
                             is_there ? numbers.lining[step.cavity] : "");
    }
    cavities_.write(cavity_csv_header(), rows);
  }

  void commit() {
    if (plot_ && !plotted_.empty()) {
      plot_->write(plot_svg(plot()));
      plot_->commit();
    }
    for (GrowingTable* table : {&series_, &atoms_, &residues_, &gradients_, &cavities_, &patches_}) table->commit();
    print_now(held_);
  }

  /// Returns the plot; its x axis is time if all frames have one, else their numbers.
  SeriesPlot plot() const {
    const bool has_times = std::ranges::all_of(plotted_, [](const FrameNote& note) { return note.time.has_value(); });
    SeriesPlot plot;
    const TimeUnit unit = time_unit(has_times ? *plotted_.back().time : 0.0);
    plot.x_title = has_times ? fmt::format("time, {}", unit.name) : "frame";
    for (const FrameNote& note : plotted_)
      plot.x.push_back(has_times ? *note.time / unit.picoseconds : static_cast<double>(note.frame));
    plot.panels = panels_;
    return plot;
  }

  /// Keeps only the numbers of a frame, because there may be many frames.
  void plot_frame(const std::vector<SeriesValue>& values, const FrameNote& note) {
    std::size_t panel = 0;
    for (const SeriesValue& value : values) {
      if (!*value.unit) continue;
      if (plotted_.empty()) panels_.push_back({fmt::format("{}, {}", value.name, value.unit), {}});
      panels_[panel++].values.push_back(value.value);
    }
    plotted_.push_back(note);
  }

  const SurfaceCommand& command_;
  GrowingTable series_, atoms_, residues_, gradients_, cavities_, patches_;
  CavityTracks tracks_;
  std::optional<OutputFile> plot_;
  std::vector<FrameNote> plotted_;
  std::vector<PlotPanel> panels_;
  std::string held_;  ///< for a single molecule: printed once its tables are complete
};

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
          return !given.scene.frames.is_requested() || given.any({"report.csv_patches", "report.json"});
        },
        "of a run, patches are written by --csv-patches FILE or --json; add one of them"},
       superposition_need({"report.csv_cavities", "report.gradients"}),
       {{"report.open_sky"}, {"report.csv_atoms"}, "it is a column of --csv FILE; add that"}});
}

/// Throws UsageError for outputs that conflict, OutputError for outputs that cannot be written. Opens the outputs
/// before the work begins, so that errors come early, and removes them again.
void check_outputs(const SurfaceCommand& command) {
  if (command.plot == "-" || (!command.plot.empty() && !command.plot.ends_with(".svg")))
    throw UsageError("--plot {}: plots are written as files whose names end in .svg", in_quotes(command.plot));
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
          "--gradients needs a whole surface of atoms; leave --by component, --cavities and --instances out");
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

/// Prints the numbers of the molecule, or a line or a row for every frame as soon as it is finished, in every requested
/// output. Files get their final names at the end, with the frames that could be made.
void print_surface(const SurfaceCommand& requested) {
  check_outputs(requested);
  SurfaceCommand command = requested;
  command.scene.frames.context = command.context;
  freeze_selections(command.scene);
  SurfaceTables(command).make();
}

}  // namespace

bool SurfaceCommand::prints_csv() const { return std::ranges::any_of(tables_of(*this), is_stdout); }

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
      "The surface encloses the polymers of the first model, or all atoms if there is no polymer: the most occupied\n"
      "conformer of each residue, without water and free ions. A line reports what was read, left out and used.\n"
      "Radii are Bondi's (`meniscus info` lists them), or the file's own (PQR, XYZR). The surface is closed and\n"
      "includes all cavities. Areas and volumes are exact. `volume` is the volume of the solid without its cavities;\n"
      "the volume of a cavity is positive. The area of an atom is the part of the surface in its colour: its contact\n"
      "patch, and the nearest parts of the patches around it. Over frames the tables of atoms and residues have rows\n"
      "for each frame, and a cavity keeps its number as long as probes that rest in it overlap.");
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
    // Planes cut parts out of surfaces, and rays meet the patches within them.
    const Division& division = declared->state.scene.molecule.division;
    SurfaceCommand& requested = declared->state;
    MoleculeRequest& molecule = requested.scene.molecule;
    molecule.reading.companions = Companions::hidden;  // --patches 'within 5 of ligand' sees them
    const bool drawn = division.components || division.cavities != Cavities::keep || requested.open_sky;
    molecule.surface.planes = drawn ? ClipPlanes::listed : ClipPlanes::left_out;
    molecule.surface.bordered =
        drawn || molecule.patches || !requested.cavity_csv.empty() || !requested.gradient_csv.empty();
    requested.summary_csv.empty() ? print_surface(requested) : print_summary(requested);
  });
}

}  // namespace meniscus
