// SPDX-License-Identifier: BSD-3-Clause
// `meniscus info`: shows a file's contents, the atoms that a surface would use, and frames and times of trajectories.
#include <iostream>
#include <tuple>

#include <fmt/ostream.h>

#include "app/commands/command_table.h"
#include "app/options/scene_options.h"
#include "app/reports/notes.h"
#include "core/base/text.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/structure/residues.h"
#include "core/trajectory/formats/trajectory_formats.h"

namespace meniscus {
namespace {

/// Atoms and residues of one kind.
struct Tally {
  std::size_t atoms = 0;
  std::size_t residues = 0;
};

void print_classes_and_chains(const Structure& structure) {
  std::map<AtomClass, Tally> classes;
  std::vector<std::pair<std::string, Tally>> chains;
  std::map<std::string, std::size_t> place;
  const Atom* previous = nullptr;
  for (const Atom& atom : structure.atoms) {
    const auto identity = [](const Atom& a) {
      return std::tie(a.chain, a.residue_number, a.insertion_code, a.residue_name);
    };
    const bool new_residue = !previous || identity(*previous) != identity(atom);
    previous = &atom;
    const auto [found, added] = place.try_emplace(atom.chain, chains.size());
    if (added) chains.emplace_back(atom.chain, Tally{});
    for (Tally* tally : {&classes[atom.kind], &chains[found->second].second}) {
      ++tally->atoms;
      tally->residues += new_residue ? 1 : 0;
    }
  }
  fmt::print(std::cout, "\n{:<14} {:>10} {:>10}\n", "class", "atoms", "residues");
  for (const auto& [kind, tally] : classes) {
    fmt::print(std::cout, "{:<14} {:>10} {:>10}\n", class_name(kind), with_thousands(tally.atoms),
               with_thousands(tally.residues));
  }
  if (classes.contains(AtomClass::unclassified)) return;  // XYZ and XYZR have no chains
  fmt::print(std::cout, "\n{:<14} {:>10} {:>10}\n", "chain", "atoms", "residues");
  for (const auto& [chain, tally] : chains) {
    fmt::print(std::cout, "{:<14} {:>10} {:>10}\n", chain.empty() ? "(none)" : escaped(chain),
               with_thousands(tally.atoms), with_thousands(tally.residues));
  }
}

/// Returns as many decimals as the source has, from two to four.
int decimals_of(double radius) {
  for (int decimals = 2; decimals < 4; ++decimals) {
    const double scale = std::pow(10.0, decimals);
    if (std::abs(radius * scale - std::round(radius * scale)) < 1e-6) return decimals;
  }
  return 4;
}

void print_radii(const Structure& structure) {
  fmt::print(std::cout, "\n{:<14} {:>10} {:>10}  {}\n", "radii of", "atoms", "radius Å", "source");
  for (const RadiusClass& row : structure.radius_classes) {
    fmt::print(std::cout, "{:<14} {:>10} {:>9.{}f}  {}\n", escaped(row.label), with_thousands(row.atoms), row.radius,
               decimals_of(row.radius), escaped(row.source));
  }
}

/// Returns the number of atoms that a surface would use: water and ions only if they are requested or named, and
/// ligands of a file with a polymer only if atoms are selected.
std::size_t count_taken(const Structure& structure, const ReadOptions& options) {
  std::vector<bool> named(structure.atoms.size());
  OutsidePolymer outside;
  if (options.selection)
    named = options.selection->names(structure.atoms);
  else
    outside = outside_polymer(structure.atoms, {});
  const bool keeps_ions = options.keep_ions || has_only_ions(structure.atoms);
  std::size_t taken = 0;
  for (std::size_t n = 0; n < structure.atoms.size(); ++n) {
    const AtomClass kind = structure.atoms[n].kind;
    const bool unwanted = (kind == AtomClass::water && !options.keep_water) || (kind == AtomClass::ion && !keeps_ions);
    const bool is_outside = !outside.part.empty() && outside.part[n] != OutsidePolymer::Part::inside;
    taken += (unwanted && !named[n]) || is_outside ? 0 : 1;
  }
  return taken;
}

void print_ranges(const Structure& structure) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec3 low(kInfinity), high(-kInfinity);
  std::array<double, 2> radius{kInfinity, -kInfinity}, b_factor{kInfinity, -kInfinity};
  for (const Atom& atom : structure.atoms) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], atom.position[axis]);
      high[axis] = std::max(high[axis], atom.position[axis]);
    }
    radius = {std::min(radius[0], atom.radius), std::max(radius[1], atom.radius)};
    if (!std::isnan(atom.b_factor))
      b_factor = {std::min<double>(b_factor[0], atom.b_factor), std::max<double>(b_factor[1], atom.b_factor)};
  }
  for (int axis = 0; axis < 3; ++axis) {
    fmt::print(std::cout, "{}             {:.3f} to {:.3f} Å (centres)\n", "xyz"[axis], low[axis], high[axis]);
  }
  fmt::print(std::cout, "radii         {:.2f} to {:.2f} Å\n", radius[0], radius[1]);
  if (b_factor[0] <= b_factor[1])
    fmt::print(std::cout, "B-factors     {:.2f} to {:.2f} Å²\n", b_factor[0], b_factor[1]);
}

/// The atoms of a topology have the positions of the first frame.
void print_structure(const SceneCommand& command, Trajectory* trajectory) {
  ReadOptions everything = command.scene.molecule.reading;
  everything.keep_water = everything.keep_ions = everything.takes_ligands = true;
  if (everything.unknown_element == UnknownElement::halt) everything.unknown_element = UnknownElement::guess;
  everything.list_assemblies = true;
  if (trajectory) {
    Frame first;
    trajectory->read(0, first);
    everything.positions = std::move(first.positions);
  }
  const Structure structure = read_structure(command.scene.molecule.file, everything);
  fmt::print(std::cout, "molecule      {} ({}, {} {})\n", escaped(structure.file), structure.format,
             structure.report.models, structure.report.models == 1 ? "model" : "models");
  fmt::print(std::cout, "atoms         {} in the file; a surface takes {} of them\n",
             with_thousands(structure.report.read),
             with_thousands(count_taken(structure, command.scene.molecule.reading)));
  if (!structure.report.excluded.empty()) fmt::print(std::cout, "below         {}\n", structure.report.sentence());
  print_ranges(structure);
  print_classes_and_chains(structure);
  print_radii(structure);
  print_assemblies(structure);
  log_warnings(command, structure);
}

void run(const SceneCommand& command, const std::string& trajectory_path) {
  const bool alone = trajectory_path.empty() && !bare_trajectory_format(command.scene.molecule.file).empty();
  TrajectoryOptions opening{cache_folder(), {}, true};
  if (!alone) opening.atoms = [&] { return count_atoms(command.scene.molecule.file, std::nullopt); };
  std::unique_ptr<Trajectory> trajectory;
  if (alone || !trajectory_path.empty())
    trajectory = open_trajectory(alone ? command.scene.molecule.file : trajectory_path, opening);
  if (!alone) print_structure(command, trajectory.get());
  if (!alone && trajectory) fmt::print(std::cout, "\n");
  if (trajectory) print_trajectory(*trajectory);
}

TakenProperties info_properties() {
  return {{"Input", "Radii", "Assembly", "-molecule.instances"},
          {{{"molecule.unknown_element"},
            [](const GivenScene&) { return false; },
            "all atoms are listed, with a guessed radius where the element is unknown"}}};
}

}  // namespace

void add_info(CLI::App& command) {
  describe(command,
           "  meniscus info 1tii.pdb\n"
           "  meniscus info 6zu5.cif.gz --select 'nucleic and chain A'\n"
           "  meniscus info 1tii.pdb --radii protor         radii of another set\n"
           "  meniscus info 1tii.pdb --radii-file amber.dat --radius 'element Zn=1.1'\n"
           "  meniscus info run.xtc                         frames, times and box of a trajectory\n"
           "  meniscus info run.psf --trajectory run.dcd");
  auto declared = std::make_shared<DeclaredCommand<>>(command, info_properties());
  command.get_option("--radii")->expected(0, 1);  // without a value it requests the radii that are printed anyway
  auto trajectory = std::make_shared<std::string>();
  PropertyOptions(command)
      .add("frames.trajectory", *trajectory)
      ->description("Also report this trajectory: coordinates of the atoms of FILE, frame by frame");
  command.callback([declared, trajectory] {
    declared->options.take();
    run(declared->state, *trajectory);
  });
}

}  // namespace meniscus
