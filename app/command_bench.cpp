// SPDX-License-Identifier: BSD-3-Clause
// `meniscus bench`: times the stages of the surface for several molecules, one row each, like table 1 of the paper
// (Krone, Dachsbacher & Ertl 2010).
#include <algorithm>
#include <iostream>
#include <memory>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "app/commands.h"
#include "app/molecule_options.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

struct BenchCommand {
  MoleculeOptions molecule;
  std::vector<std::string> files;
  int runs = 5;
};

/// One measured molecule: the run with the median total.
struct Row {
  std::string file;
  std::size_t atoms = 0;
  std::string device;
  std::vector<StageTime> stages;
};

/// Runs once to warm the caches, then `runs` times.
Row measure(const Structure& structure, const BenchCommand& command) {
  const std::vector<Ball> balls = balls_of(structure);
  Row row{structure.file, balls.size(), compute_surface(balls, command.molecule.computing).device, {}};
  std::vector<std::vector<StageTime>> times;
  for (int n = 0; n < command.runs; ++n) times.push_back(compute_surface(balls, command.molecule.computing).stages);
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end(),
                   [](const auto& a, const auto& b) { return total_ms(a) < total_ms(b); });
  row.stages = *middle;
  return row;
}

void print_table(const std::vector<Row>& rows) {
  std::size_t width = 8;
  for (const Row& row : rows) width = std::max(width, escaped(row.file).size());
  fmt::print(std::cout, "{:<{}} {:>9}", "molecule", width, "atoms");
  for (const StageTime& stage : rows.front().stages)
    fmt::print(std::cout, " {:>{}}", stage.name, std::max<std::size_t>(stage.name.size(), 9));
  fmt::print(std::cout, " {:>9} {:>9}  device\n", "total ms", "per s");
  for (const Row& row : rows) {
    fmt::print(std::cout, "{:<{}} {:>9}", escaped(row.file), width, with_thousands(row.atoms));
    for (const StageTime& stage : row.stages) {
      fmt::print(std::cout, " {:>{}.2f}", stage.milliseconds, std::max<std::size_t>(stage.name.size(), 9));
    }
    const double total = total_ms(row.stages);
    fmt::print(std::cout, " {:>9.2f} {:>9.1f}  {}\n", total, 1000.0 / total, row.device);
  }
}

void run(BenchCommand& command) {
  std::vector<Row> rows;
  for (const std::string& file : command.files) {
    command.molecule.file = file;
    rows.push_back(measure(read_molecule(command.molecule), command));
  }
  print_table(rows);
}

}  // namespace

void add_bench(CLI::App& command) {
  describe(command, "Time the stages of the surface computation for several files",
           "  meniscus bench 1ubq.pdb 1tii.pdb            a row each: stages, total, surfaces per second\n"
           "  meniscus bench 6zu5.cif --device cpu --threads 1 --runs 20");
  auto state = std::make_shared<BenchCommand>();
  command.add_option("FILES", state->files, "Molecules: PDB, mmCIF (.gz too) or XYZR")->required();
  add_surface_options(command, state->molecule);
  command.add_option("--runs", state->runs, "Timed runs of each; the median is shown [5]")
      ->check(CLI::Range(1, 1000000).description(""))
      ->type_name("N");
  command.add_flag("-q,--quiet", state->molecule.quiet, "No notes on stderr; errors only");
  command.callback([state] { run(*state); });
}

}  // namespace meniscus
