// SPDX-License-Identifier: BSD-3-Clause
// `meniscus morph`: makes a path from one structure to another, as models of a PDB file.

#include "app/commands/command_table.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/progress.h"
#include "core/base/text.h"
#include "core/structure/formats/pdb_records.h"
#include "core/trajectory/morph.h"

namespace meniscus {
namespace {

struct MorphCommand : SceneCommand {
  std::vector<std::string> files;
  std::uint32_t steps = 50;
};

CommonAtoms read_common(const MorphCommand& command) {
  const std::optional<Selection> superposed = command.scene.molecule.reading.superpose_on;
  SceneCommand reading = command;
  reading.scene.molecule.reading.superpose_on.reset();
  std::vector<Structure> structures;
  std::vector<std::vector<bool>> fitted;
  for (const std::string& file : command.files) {
    reading.scene.molecule.file = file;
    structures.push_back(read_and_log(reading));
    const std::vector<Atom>& atoms = structures.back().atoms;
    fitted.push_back(superposed ? superposed->evaluate(atoms) : std::vector<bool>(atoms.size(), true));
  }
  CommonAtoms common = common_atoms(structures, fitted);
  for (std::size_t n = 0; n < common.fits.size(); ++n)
    log_line(command, fmt::format("{} is superposed on {} by {} atoms with an RMSD of {:.3f} Å", command.files[n + 1],
                                  command.files.front(), with_thousands(common.fits[n].atoms), common.fits[n].rmsd));
  log_line(command, fmt::format("{} of {} atoms are in all structures", with_thousands(common.atoms.size()),
                                with_thousands(structures.front().atoms.size())));
  return common;
}

/// Measures of the quality of a path.
struct PathFaults {
  double bonds = 0.0;    ///< largest deviation of a bond's length from the range between both ends, Å
  double step = 0.0;     ///< longest step of an atom from a model to the next, Å
  double overlap = 0.0;  ///< largest Morph::overlap() of a model

  void include(const Morph& morph, std::size_t stop, double share, const std::vector<glm::dvec3>& before,
               const std::vector<glm::dvec3>& now) {
    const std::size_t next = std::min(stop + 1, morph.stops() - 1);
    const auto length = [](const std::vector<glm::dvec3>& x, const Bond& bond) {
      return glm::distance(x[bond[0]], x[bond[1]]);
    };
    for (const Bond& bond : morph.bonds())
      bonds = std::max(bonds, std::abs(length(now, bond) - (1.0 - share) * length(morph.at(stop), bond) -
                                       share * length(morph.at(next), bond)));
    if (share > 0.0) overlap = std::max(overlap, morph.overlap(stop, now));
    for (std::size_t a = 0; a < before.size(); ++a) step = std::max(step, glm::distance(before[a], now[a]));
  }
};

void run(const MorphCommand& command) {
  if (command.files.size() < 2) throw UsageError("a path needs two structures or more");
  check_output(command.scene.output, command.existing());
  const Morph morph(read_common(command));
  PdbModels models(command.scene.output, command.existing(), morph.atoms());
  const std::size_t ways = morph.stops() - 1, count = ways * command.steps + 1;
  Progress progress(progress_on_stderr(command), "path", ways);
  PathFaults faults;
  std::vector<glm::dvec3> before;
  const auto add = [&](std::size_t stop, double share, std::vector<glm::dvec3> now) {
    faults.include(morph, stop, share, before, now);
    models.add(now);
    before = std::move(now);
  };
  for (std::size_t stop = 0; stop < ways; ++stop) {
    std::vector<std::vector<glm::dvec3>> way = morph.models(stop, command.steps);
    for (std::size_t n = 0; n < way.size(); ++n) add(stop, static_cast<double>(n) / command.steps, std::move(way[n]));
    progress.advance();
  }
  add(ways, 0.0, morph.at(ways));
  models.commit();
  log_line(command,
           fmt::format("{} models; bonds are within {:.3f} Å of lengths between those at both ends; from a model to "
                       "the next no atom moves by more than {:.2f} Å",
                       with_thousands(count), faults.bonds, faults.step));
}

}  // namespace

void add_morph(CLI::App& command) {
  describe(
      command,
      "  meniscus morph open.pdb closed.pdb -o path.pdb\n"
      "  meniscus render path.pdb --frames all --color chain -o path.mp4\n"
      "  meniscus morph a.cif b.cif c.cif --select 'chain A' --superpose-on 'name CA and resid 1-29' --steps 100 -o "
      "path.pdb",
      "Atoms that all structures share are moved. They are paired by sequence, so chain names and residue numbers may\n"
      "differ. Bonds keep their lengths, domains move as bodies, and atoms do not pass through one another.");
  auto declared = std::make_shared<DeclaredCommand<MorphCommand>>(
      command, TakenProperties{"molecule.superpose_on", "molecule.select", "molecule.warnings", "molecule.quiet",
                               "output.file", "output.force"});
  declared->options.describe_output("PDB file to write, one model for each step");
  PropertyOptions options(command);
  options.add("morph.files", declared->state.files)->required();
  options.add("morph.steps", declared->state.steps);
  declared->options.option("molecule.superpose_on")
      ->description(
          "Superpose the structures on the first one by these atoms, such as 'name CA'. Those that they have in "
          "common count [all]");
  command.callback([declared] {
    declared->options.take();
    run(declared->state);
  });
}

}  // namespace meniscus
