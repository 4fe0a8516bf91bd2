// SPDX-License-Identifier: BSD-3-Clause
// Prints and writes the results of `meniscus surface`: numbers of a molecule, or a line or row per frame, with cavities
// tracked from one frame to the next.
#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/commands/number_run.h"
#include "app/commands/surface_command.h"
#include "app/reports/csv_tables.h"
#include "app/reports/notes.h"
#include "app/reports/series_plot.h"
#include "app/reports/surface_report.h"
#include "core/base/output_file.h"
#include "core/mesh/open_sky.h"
#include "core/mesh/tessellate.h"
#include "core/queries/cavity_tracks.h"
#include "core/base/time_unit.h"
#include "core/scene/context_areas.h"
#include "core/scene/gradient_columns.h"
#include "core/scene/molecule.h"
#include "core/scene/settled_selections.h"

namespace meniscus {
namespace {

/// The numbers of a molecule, or of a frame before its place among the others matters.
struct SurfaceNumbers {
  std::vector<SeriesValue> values;
  std::string printed, atom_header, atoms, residue_header, residues, gradient_header, gradients, patches;
  std::vector<Cavity> cavities;
  std::vector<std::string> lining;  ///< of each cavity
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
      if (!note) tell_built(command_, molecule);
      auto numbers = std::make_shared<SurfaceNumbers>(numbers_of(molecule, numbered.together, note, *builder));
      return [this, numbers, note] { return finish(*numbers, note); };
    };
  }

  SurfaceNumbers numbers_of(const Molecule& molecule, const Structure& together, const std::optional<FrameNote>& note,
                            MoleculeBuilder& builder) const {
    SurfaceNumbers numbers;
    const SurfaceKind kind = command_.scene.molecule.surface.kind;
    const bool by_atom = !note || command_.json || command_.context || atoms_.is_wanted() || residues_.is_wanted();
    std::vector<AreaColumn> columns =
        by_atom ? area_columns(molecule.structure, molecule.objects, kind) : area_totals(molecule.objects, kind);
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
      numbers.printed = printed({molecule, command_.scene.molecule, columns, context, patches}, note);
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

  /// The x axis is time if all frames have one, else their numbers.
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

  /// Only the numbers of a frame are kept, because there may be many frames.
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

}  // namespace

void print_surface(const SurfaceCommand& asked) {
  check_outputs(asked);
  SurfaceCommand command = asked;
  command.scene.frames.context = command.context;
  settle_selections(command.scene);
  SurfaceTables(command).make();
}

}  // namespace meniscus
