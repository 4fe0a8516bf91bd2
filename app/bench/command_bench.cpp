// SPDX-License-Identifier: BSD-3-Clause
// `meniscus bench`: times the stages of the surface for several molecules, one row each, like table 1 of the paper
// (Krone, Dachsbacher & Ertl 2010).
#include <iostream>
#include <tuple>

#include <fmt/ostream.h>

#include "app/bench/paper_bench.h"
#include "app/bench/rolling_probe.h"
#include "app/commands/command_table.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/text.h"
#include "core/scene/molecule.h"
#include "core/structure/formats/structure_formats.h"

namespace meniscus {
namespace {

struct BenchCommand : SceneCommand {
  std::vector<std::string> files;
  int runs = 5;
  bool baseline = false;
  bool paper = false;
  bool numbers = false;
};

/// One measured molecule: the run with the median total.
struct Row {
  std::string file;
  std::size_t atoms = 0;
  std::string device;
  std::vector<StageTime> stages;
  std::vector<StageTime> baseline;  ///< the sequential algorithm, reduced surface only; empty unless requested
};

/// Times Sanner's sequential rolling probe: the part that classical programs find, and the complete surface.
std::vector<StageTime> roll(const std::vector<Ball>& balls, double probe_radius) {
  StageClock clock;
  for (const auto& [scope, name] :
       {std::pair{RollingScope::outer_component, "rolled, outer"}, {RollingScope::complete, "rolled, all"}}) {
    const auto stage = clock.stage(name);
    roll_probe(balls, probe_radius, scope);
  }
  return clock.times();
}

/// Returns the run with the median total.
std::vector<StageTime> median(std::vector<std::vector<StageTime>> runs) {
  const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
  std::nth_element(runs.begin(), middle, runs.end(),
                   [](const auto& a, const auto& b) { return total_ms(a) < total_ms(b); });
  return *middle;
}

/// Runs once to warm the caches, then `runs` times.
Row measure(const Structure& structure, const BenchCommand& command, Progress& progress) {
  const std::vector<Ball> balls = balls_of(structure);
  Row row{std::filesystem::path(structure.file).filename().string(),
          balls.size(),
          compute_surface(balls, command.scene.molecule.surface).device,
          {},
          {}};
  std::vector<std::vector<StageTime>> times, baselines;
  for (int n = 0; n < command.runs; ++n) {
    times.push_back(compute_surface(balls, command.scene.molecule.surface).stages);
    if (command.baseline) baselines.push_back(roll(balls, command.scene.molecule.surface.probe_radius));
    progress.advance();
  }
  row.stages = median(std::move(times));
  if (command.baseline) row.baseline = median(std::move(baselines));
  return row;
}

/// Returns the stages of all rows in order of appearance, because not every molecule needs every stage.
std::vector<std::string> stage_names(const std::vector<Row>& rows) {
  std::vector<std::string> names;
  for (const Row& row : rows) {
    for (const StageTime& stage : row.stages) {
      if (std::find(names.begin(), names.end(), stage.name) == names.end()) names.push_back(stage.name);
    }
  }
  return names;
}

std::string stage_cell(const Row& row, const std::string& name) {
  const auto found =
      std::find_if(row.stages.begin(), row.stages.end(), [&](const StageTime& s) { return s.name == name; });
  return found == row.stages.end() ? "-" : fmt::format("{:.2f}", found->milliseconds);
}

void print_table(const std::vector<Row>& rows) {
  std::size_t width = 8;
  for (const Row& row : rows) width = std::max(width, escaped(row.file).size());
  const std::vector<std::string> names = stage_names(rows);
  const auto column = [](const std::string& name) { return std::max<std::size_t>(name.size(), 8) + 1; };
  fmt::print(std::cout, "{:<{}} {:>9}", "molecule", width, "atoms");
  for (const std::string& name : names) fmt::print(std::cout, " {:>{}}", name, column(name));
  fmt::print(std::cout, " {:>9} {:>9}", "total ms", "per s");
  for (const StageTime& time : rows.front().baseline) fmt::print(std::cout, " {:>14}", time.name);
  fmt::print(std::cout, "  device\n");
  for (const Row& row : rows) {
    fmt::print(std::cout, "{:<{}} {:>9}", escaped(row.file), width, with_thousands(row.atoms));
    for (const std::string& name : names) fmt::print(std::cout, " {:>{}}", stage_cell(row, name), column(name));
    const double total = total_ms(row.stages);
    fmt::print(std::cout, " {:>9.2f} {:>9.1f}", total, 1000.0 / total);
    for (const StageTime& time : row.baseline) fmt::print(std::cout, " {:>14.2f}", time.milliseconds);
    fmt::print(std::cout, "  {}\n", row.device);
  }
}

void run_paper(BenchCommand& command) {
  if (command.numbers) throw UsageError("--numbers times surfaces, --paper frames; choose one");
  if (command.baseline) throw UsageError("--baseline times surfaces, --paper frames; choose one");
  if (command.scene.molecule.surface.verify) throw UsageError("--verify compares surfaces, --paper times frames");
  if (command.scene.molecule.surface.kind != SurfaceKind::ses)
    throw UsageError("--paper draws solvent-excluded surfaces only");
  PaperBenchSettings settings;
  settings.device = command.scene.molecule.surface.gl;
  settings.size = {command.scene.picture.width, command.scene.picture.height};
  settings.probe_radius = command.scene.molecule.surface.probe_radius;
  settings.runs = command.runs;
  std::vector<PaperBenchMolecule> molecules;
  for (const std::string& file : command.files) {
    command.scene.molecule.file = file;
    molecules.push_back({std::filesystem::path(file).filename().string(), balls_of(read_and_log(command))});
  }
  print_paper_tables(molecules, settings);
}

void run(BenchCommand& command) {
  if (command.paper) return run_paper(command);
  if (command.numbers) command.scene.molecule.surface.planes = ClipPlanes::left_out;
  Progress progress(progress_on_stderr(command), "bench",
                    command.files.size() * static_cast<std::size_t>(command.runs));
  std::vector<Row> rows;
  for (const std::string& file : command.files) {
    command.scene.molecule.file = file;
    rows.push_back(measure(read_and_log(command), command, progress));
  }
  print_table(rows);
}

}  // namespace

void add_bench(CLI::App& command) {
  describe(command,
           "  meniscus bench 1ubq.pdb 1tii.pdb            one row per file: stages, total, surfaces per second\n"
           "  meniscus bench 6zu5.cif --device cpu --threads 1 --runs 20\n"
           "  meniscus bench --paper 1crn.pdb 1vis.pdb 1tii.pdb   frames as in the paper, beside its own figures",
           "All times are wall-clock milliseconds: the medians of the runs, after one run that is not counted. They "
           "do\nnot include reading the file.");
  auto declared = std::make_shared<DeclaredCommand<BenchCommand>>(
      command, TakenProperties{"molecule.quiet", "surface.kind", "surface.probe", "Computing", "image.size"});
  BenchCommand& state = declared->state;
  command.add_option("FILES", state.files, "Molecules: " + format_names() + "; .gz too")->required();
  PropertyOptions options(command);
  options.add("bench.runs", state.runs);
  options.add("bench.numbers", state.numbers);
  options.add("bench.baseline", state.baseline);
  options.add("bench.paper", state.paper);
  declared->options.option("image.size")->description("With --paper: size of the frames in pixels [1024x768]");
  command.callback([declared] {
    BenchCommand& requested = declared->state;
    requested.scene.molecule.surface.timing = StageTiming::exact;
    declared->options.take();
    if (!declared->options.is_given("image.size"))
      std::tie(requested.scene.picture.width, requested.scene.picture.height) = std::pair(1024, 768);
    run(requested);
  });
}

}  // namespace meniscus
