// SPDX-License-Identifier: BSD-3-Clause
// Chooses the reader, then decides atom by atom what is used, and keeps the account.
#include "core/structure/formats/read_structure.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/plausibility.h"
#include "core/structure/usual_part.h"

namespace meniscus {
namespace {

/// Lone pairs and the mass-less sites of water models (LP, EP, M, MW, with digits), and the dummy atoms with which the
/// OPM database draws membranes.
bool is_virtual_site(const Atom& atom) {
  if (atom.residue_name == "DUM") return true;
  if (atom.element != 0) return false;
  const std::string letters = atom.name.substr(0, atom.name.find_first_of("0123456789"));
  for (const char* name : {"LP", "EP", "M", "MW", "EPW", "VS"}) {
    if (letters == name) return true;
  }
  return false;
}

bool is_hydrogen(const Atom& atom) { return atom.element == 1; }

/// Moves the atoms without a reason to be left out to the front of `atoms`, drops the others and counts their reasons.
template <typename Reason>
void leave_out(std::vector<Atom>& atoms, ReadReport& report, Reason&& reason_of) {
  std::size_t kept = 0;
  for (std::size_t n = 0; n < atoms.size(); ++n) {
    if (const char* reason = reason_of(n)) {
      ++report.excluded[reason];
    } else {
      if (kept != n) atoms[kept] = std::move(atoms[n]);
      ++kept;
    }
  }
  atoms.resize(kept);
}

std::vector<bool> evaluate(const Selection& selection, const std::vector<Atom>& atoms, const RadiiChoice& radii,
                           const std::string& path) {
  if (selection.uses_radius() && !radii.from_molecule_file()) {
    throw InputError(path, 0, "has no radii to select by yet; they are given to atoms once these are selected");
  }
  std::vector<bool> selected = selection.evaluate(atoms);
  if (std::find(selected.begin(), selected.end(), true) == selected.end()) {
    throw InputError(path, 0,
                     fmt::format("none of its {} atoms is selected by {}; chains and names are case-sensitive",
                                 with_thousands(atoms.size()), in_quotes(selection.text())));
  }
  return selected;
}

bool keeps_hydrogens(const std::vector<Atom>& atoms, const ReadOptions& options, const RadiiChoice& radii) {
  if (options.hydrogens != Hydrogens::automatic) return options.hydrogens == Hydrogens::keep;
  return !radii.united(std::any_of(atoms.begin(), atoms.end(), [](const Atom& atom) { return is_hydrogen(atom); }));
}

/// What each atom is left out for, in the order of the reasons in structure.h.
void choose_atoms(std::vector<Atom>& atoms, const ReadOptions& options, const RadiiChoice& radii, ReadReport& report,
                  const std::string& path) {
  const std::vector<char> altlocs = kept_altlocs(atoms, options.altloc);
  const bool all_altlocs = options.altloc.rule == AltlocChoice::Rule::all;
  leave_out(atoms, report, [&](std::size_t n) -> const char* {
    if (atoms[n].altloc != ' ' && atoms[n].altloc != altlocs[atoms[n].residue] && !all_altlocs) return kExcludedAltloc;
    return !radii.from_molecule_file() && is_virtual_site(atoms[n]) ? kExcludedVirtual : nullptr;
  });
  std::vector<bool> selected(atoms.size(), true), named(atoms.size());
  if (options.selection) {
    selected = evaluate(*options.selection, atoms, radii, path);
    named = options.selection->names(atoms);
  }
  const bool hydrogens = keeps_hydrogens(atoms, options, radii);
  leave_out(atoms, report, [&](std::size_t n) -> const char* {
    const Atom& atom = atoms[n];
    if (!selected[n]) return kExcludedSelection;
    if (radii.from_molecule_file()) {
      if (atom.radius == 0.0) return kExcludedRadius;
    } else if (atom.element == 0 && options.unknown_element == UnknownElement::skip) {
      return kExcludedElement;
    }
    if (!hydrogens && is_hydrogen(atom)) return kExcludedHydrogen;
    if (atom.kind == AtomClass::water && !options.keep_water && !named[n]) return kExcludedWater;
    if (atom.kind == AtomClass::ion && !options.keep_ions && !named[n]) return kExcludedIon;
    return nullptr;
  });
}

void refuse_no_atoms(const Structure& structure) {
  if (!structure.atoms.empty()) return;
  throw InputError(structure.file, 0,
                   fmt::format("leaves no atoms to make a surface of: {}; --keep-water and --keep-ions use more",
                               structure.report.sentence()));
}

void halt_on_unknown_elements(const Structure& structure, const std::vector<std::string>& unknown) {
  if (unknown.empty()) return;
  const std::set<std::string> names(unknown.begin(), unknown.end());
  std::string examples;
  for (const std::string& name : names) {
    if (examples.size() > 100) {
      examples += ", ...";
      break;
    }
    examples += (examples.empty() ? "" : ", ") + escaped(name);
  }
  throw InputError(structure.file, 0,
                   fmt::format("the element of {} {} is unknown: {}; correct the element column, or choose "
                               "--unknown-element guess or skip",
                               with_thousands(unknown.size()), unknown.size() == 1 ? "atom" : "atoms", examples));
}

void require_model(const std::string& path, const ModelChoice& choice, std::size_t models) {
  if (choice.all || static_cast<std::size_t>(choice.number) <= models) return;
  throw InputError(path, 0,
                   fmt::format("has no model {}: it holds {} {}; choose --model 1{}", choice.number, models,
                               models == 1 ? "model" : "models", models == 1 ? "" : fmt::format(" to {}", models)));
}

void warn_of_missing_altloc(Structure& structure, const std::vector<Atom>& atoms, const AltlocChoice& choice) {
  if (choice.rule != AltlocChoice::Rule::letter) return;
  if (std::any_of(atoms.begin(), atoms.end(), [&](const Atom& atom) { return atom.altloc == choice.letter; })) return;
  structure.report.warnings.emplace_back(
      fmt::format("no atom has the alternate location {}; the best one of each residue is used", choice.letter));
}

/// The atoms of a topology stand where the options say.
void place_atoms(FileContents& contents, const ReadOptions& options, const TextFile& file) {
  if (!contents.without_positions) return;
  if (options.positions.empty())
    throw InputError(file.path, 0, "lists atoms without coordinates; add --trajectory with a file that has them");
  if (options.positions.size() != contents.atoms.size()) {
    throw InputError(file.path, 0,
                     fmt::format("lists {} atoms, a frame of the trajectory has {}: {}",
                                 with_thousands(contents.atoms.size()), with_thousands(options.positions.size()),
                                 advice_on_count(contents.atoms, options.positions.size())));
  }
  for (std::size_t n = 0; n < contents.atoms.size(); ++n) contents.atoms[n].position = options.positions[n];
}

/// Builds the assembly that is asked for; lists all when asked to, and then takes broken records as a warning.
void use_assemblies(Structure& structure, const TextFile& file, const Reader& reader, const ReadOptions& options) {
  if (options.list_assemblies && reader.assemblies) {
    try {
      structure.assemblies = reader.assemblies(file);
    } catch (const InputError& error) {
      structure.report.warnings.push_back(std::string("its assemblies cannot be read: ") + error.what());
    }
  }
  if (options.assembly.empty()) return;
  if (!reader.assemblies) {
    throw InputError(structure.file, 0,
                     fmt::format("is {}, which describes no assemblies; leave --assembly away", reader.metadata.name));
  }
  const std::vector<Assembly> assemblies = reader.assemblies(file);
  assemble(structure, find_assembly(assemblies, options.assembly, structure.file), options.copy_mode);
}

}  // namespace

Structure read_structure(const std::string& path, const ReadOptions& options) {
  const TextFile file = read_text_file(path);
  Structure structure;
  structure.file = file.path;
  ReadReport& report = structure.report;
  const Reader& reader = choose_reader(file);
  structure.format = reader.metadata.name;

  FileContents contents = reader.read(file, options.model);
  require_model(file.path, options.model, contents.models);
  report.read = contents.atoms.size() + contents.other_model_atoms;
  report.models = contents.models;
  report.warnings.insert(report.warnings.end(), contents.warnings.begin(), contents.warnings.end());
  if (contents.other_model_atoms > 0) report.excluded[kExcludedModel] = contents.other_model_atoms;
  place_atoms(contents, options, file);
  if (options.keep_topology)
    structure.topology = std::make_shared<const Topology>(Topology{contents.atoms, std::move(contents.bonds)});

  warn_of_missing_altloc(structure, contents.atoms, options.altloc);
  const RadiiChoice radii(options.radii, file.path, contents.radii_from_file);
  choose_atoms(contents.atoms, options, radii, report, file.path);
  structure.atoms = std::move(contents.atoms);
  report.used = structure.atoms.size();
  refuse_no_atoms(structure);
  const std::vector<std::string> unknown = radii.assign(structure);
  if (options.unknown_element == UnknownElement::halt) halt_on_unknown_elements(structure, unknown);
  refuse_no_atoms(structure);
  warn_of_coincident_atoms(structure);
  if (!contents.radii_from_file) warn_of_wrong_unit(structure);
  use_assemblies(structure, file, reader, options);
  return structure;
}

}  // namespace meniscus
