// SPDX-License-Identifier: BSD-3-Clause
// Chooses the reader of a file, decides for each atom whether it is used, and counts the decisions.
#include "core/structure/formats/read_structure.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/structure/bonds.h"
#include "core/structure/formats/added_files.h"
#include "core/structure/martini.h"
#include "core/structure/plausibility.h"
#include "core/structure/secondary_structure.h"

namespace meniscus {
namespace {

/// True for lone pairs (names beginning with LP), for massless sites of water models (EP, M, MW, with digits) and of
/// AutoDock (G in opened rings, TZ at zinc), and for the dummy atoms by which the OPM database draws membranes.
bool is_virtual_site(const Atom& atom) {
  if (atom.residue_name == "DUM") return true;
  if (atom.element != 0) return false;
  const std::string letters = atom.name.substr(0, atom.name.find_first_of("0123456789"));
  for (const char* name : {"EP", "M", "MW", "EPW", "VS", "G", "TZ", "CA"}) {
    if (letters == name) return true;
  }
  return letters.starts_with("LP") || letters.starts_with("Lp");
}

bool is_hydrogen(const Atom& atom) { return atom.element == 1; }

/// True if an atom that is left out has a charge in the file's potential and a ball in a surface of the whole file. An
/// atom of another alternate location has none, because it is at the place of an atom that is used.
bool has_charge_and_room(const Atom& atom, std::string_view reason) {
  return atom.charge != 0.0f && !std::isnan(atom.charge) && reason != kExcludedAltloc && reason != kExcludedVirtual &&
         reason != kExcludedRadius;
}

/// Moves the atoms without a reason for leaving them out to the front of `atoms`. The reasons of the others are
/// counted, and the others that are shown are moved to `extra_atoms`.
template <typename Reason>
void leave_out(std::vector<Atom>& atoms, std::vector<Atom>& extra_atoms, ReadReport& report, Reason&& reason_of) {
  std::size_t kept = 0;
  std::pair<std::uint32_t, std::uint32_t> last_residue{0xffffffffu, 0};
  for (std::size_t n = 0; n < atoms.size(); ++n) {
    if (const char* reason = reason_of(n)) {
      ++report.excluded[reason];
      const std::pair residue{atoms[n].residue, atoms[n].copy};
      if ((reason == kExcludedLigand || reason == kExcludedLipid) && residue != last_residue)
        ++report.residues[reason][atoms[n].residue_name];
      last_residue = residue;
      if (has_charge_and_room(atoms[n], reason)) ++report.charged[reason];
      if (atoms[n].shown != 0) extra_atoms.push_back(std::move(atoms[n]));
    } else {
      if (kept != n) atoms[kept] = std::move(atoms[n]);
      ++kept;
    }
  }
  atoms.resize(kept);
}

/// The positions for which selections are evaluated: the current ones; those in a frame of a trajectory, where nothing
/// may be selected; or all that atoms may have.
enum class PositionScope { current, frame, any };

std::vector<bool> select(const Selection& selection, const std::vector<Atom>& atoms, PositionScope scope) {
  return scope == PositionScope::any ? selection.possible(atoms).selected : selection.evaluate(atoms);
}

std::vector<bool> evaluate(const Selection& selection, const std::vector<Atom>& atoms, const RadiiChoice& radii,
                           const std::string& path, PositionScope scope) {
  if (selection.uses_radius() && !radii.from_molecule_file())
    throw InputError(path, 0,
                     "has no radii yet: they are assigned after the selection, so 'radius' cannot be used in it");
  std::vector<bool> selected = select(selection, atoms, scope);
  if (std::find(selected.begin(), selected.end(), true) == selected.end())
    throw InputError(path, 0, "none of its {} atoms is selected by {}; {}", with_thousands(atoms.size()),
                     in_quotes(selection.text()), selection.why_none(atoms));
  return selected;
}

bool keeps_hydrogens(const std::vector<Atom>& atoms, const ReadOptions& options, const RadiiChoice& radii) {
  if (options.hydrogens != Hydrogens::automatic) return options.hydrogens == Hydrogens::keep;
  return !radii.united(std::any_of(atoms.begin(), atoms.end(), [](const Atom& atom) { return is_hydrogen(atom); }));
}

/// Decides for atoms of the right model and alternate location whether they are used.
class Choice {
 public:
  Choice(const std::vector<Atom>& atoms, const ReadOptions& options, const RadiiChoice& radii)
      : options_(options),
        from_file_(radii.from_molecule_file()),
        hydrogens_(keeps_hydrogens(atoms, options, radii)),
        ions_(options.keep_ions || has_only_ions(atoms)) {}

  /// Returns the reason for leaving an atom out; null if it is used. named: true if the selection names the atom.
  const char* reason(const Atom& atom, bool selected, bool named) const {
    if (!selected) return kExcludedSelection;
    if (from_file_) {
      if (atom.radius == 0.0) return kExcludedRadius;
    } else if (atom.element == 0 && options_.unknown_element == UnknownElement::skip) {
      return kExcludedElement;
    }
    if (!hydrogens_ && is_hydrogen(atom)) return kExcludedHydrogen;
    if (atom.kind == AtomClass::water && !options_.keep_water && !named) return kExcludedWater;
    if (atom.kind == AtomClass::ion && !ions_ && !named) return kExcludedIon;
    return nullptr;
  }

 private:
  const ReadOptions& options_;
  bool from_file_, hydrogens_, ions_;
};

/// Marks the companions: atoms outside of the polymer that pictures draw, and that neither the surface nor sticks,
/// balls or spheres have.
void mark_companions(std::vector<Atom>& atoms, const OutsidePolymer& outside, const Choice& choice,
                     const ReadOptions& options) {
  if (options.companions == Companions::none) return;
  std::uint32_t drawn = 0;
  for (std::size_t bit = 0; bit < options.shown.size(); ++bit)
    if (options.shown[bit].each_is_drawn) drawn |= 1u << bit;
  for (Atom& atom : atoms) {
    const bool ion = atom.kind == AtomClass::ion;
    if (!outside.drawn[atom.index] || (ion && options.keep_ions) || (atom.shown & drawn) != 0) continue;
    if (choice.reason(atom, true, ion)) continue;
    atom.shown |= 1u << (options.companions == Companions::hidden ? kHiddenCompanion
                         : ion                                    ? kCompanionSpheres
                                                                  : kCompanionSticks);
  }
}

/// Sets Atom::shown. Throws InputError if a selection shows no atoms, except in a frame.
void mark_shown(std::vector<Atom>& atoms, std::span<const ShownAtoms> shown, const Choice& choice,
                const RadiiChoice& radii, const std::string& path, PositionScope scope) {
  if (shown.size() > kMostShown)
    throw CapacityError("{} sets of atoms beside the surface are too many; the most is {}", shown.size(), kMostShown);
  for (std::size_t bit = 0; bit < shown.size(); ++bit) {
    const Selection& selection = shown[bit].atoms;
    if (selection.uses_radius() && !radii.from_molecule_file())
      throw InputError(path, 0, "has no radii yet, so {} cannot select by them", option_name(shown[bit].option));
    const std::vector<bool> selected = select(selection, atoms, scope), named = selection.names(atoms);
    bool any = false;
    for (std::size_t n = 0; n < atoms.size(); ++n) {
      if (choice.reason(atoms[n], selected[n], named[n])) continue;
      atoms[n].shown |= 1u << bit;
      any = true;
    }
    if (any || scope == PositionScope::frame) continue;
    if (!shown[bit].lack.empty()) throw InputError(path, 0, shown[bit].lack);
    throw InputError(path, 0,
                     "none of its {} atoms is shown by {}; chains and names are case-sensitive, water "
                     "and free ions are shown where the expression names them",
                     with_thousands(atoms.size()),
                     option_name(fmt::format("{} {}", shown[bit].option, in_quotes(selection.text()))));
  }
}

/// Leaves out atoms for the reasons in structure.h, in their order.
void choose_atoms(std::vector<Atom>& atoms, const std::vector<bool>& sites, const OutsidePolymer& outside,
                  std::vector<Atom>& extra_atoms, const ReadOptions& options, const RadiiChoice& radii,
                  ReadReport& report, const std::string& path, PositionScope scope) {
  const std::vector<bool> of_kept_altlocs = kept_alternates(atoms, options.altloc, report.warnings);
  leave_out(atoms, extra_atoms, report, [&](std::size_t n) -> const char* {
    if (!of_kept_altlocs[n]) return kExcludedAltloc;
    const bool is_site = (atoms[n].index < sites.size() && sites[atoms[n].index]) || is_virtual_site(atoms[n]);
    return !radii.from_molecule_file() && is_site ? kExcludedVirtual : nullptr;
  });
  if (options.secondary_structure) assign_secondary_structure(atoms);
  std::vector<bool> selected(atoms.size(), true), named(atoms.size());
  if (options.selection) {
    for (const Selection& side : options.required_parts) evaluate(side, atoms, radii, path, scope);
    selected = evaluate(*options.selection, atoms, radii, path, scope);
    named = options.selection->names(atoms);
  }
  const Choice choice(atoms, options, radii);
  mark_shown(atoms, options.shown, choice, radii, path, scope);
  if (!outside.drawn.empty()) mark_companions(atoms, outside, choice, options);
  leave_out(atoms, extra_atoms, report, [&](std::size_t n) -> const char* {
    if (const char* reason = choice.reason(atoms[n], selected[n], named[n])) return reason;
    if (outside.part.empty()) return nullptr;
    switch (outside.part[atoms[n].index]) {
      case OutsidePolymer::Part::ligand:
        return kExcludedLigand;
      case OutsidePolymer::Part::lipid:
        return kExcludedLipid;
      case OutsidePolymer::Part::inside:
        break;
    }
    return nullptr;
  });
}

/// True if atoms may be marked as shown in addition to the surface.
bool marks_atoms(const ReadOptions& options) {
  return !options.shown.empty() || options.companions != Companions::none;
}

/// Assigns radii to the atoms in `extra_atoms`. Returns the labels of those whose element is unknown.
std::vector<std::string> assign_extra_radii(Structure& structure, const RadiiChoice& radii) {
  if (structure.extra_atoms.empty()) return {};
  Structure extra;
  extra.atoms = std::move(structure.extra_atoms);
  std::vector<std::string> unknown = radii.assign(extra);
  structure.extra_atoms = std::move(extra.atoms);
  return unknown;
}

void assemble_extra_atoms(Structure& structure, const Assembly& assembly) {
  std::erase_if(structure.extra_atoms, [&](const Atom& atom) { return !names_chain_of(assembly, atom); });
  if (structure.extra_atoms.empty()) return;
  Structure extra;
  extra.file = structure.file;
  extra.atoms = std::move(structure.extra_atoms);
  assemble(extra, assembly, CopyMode::atoms);
  structure.extra_atoms = std::move(extra.atoms);
}

/// Returns the bonds of all shown atoms, as places in `atoms` followed by `extra_atoms`.
std::vector<Bond> find_shown_bonds(const Structure& structure, const FileContents& contents) {
  const std::size_t own = structure.atoms.size();
  const auto atom = [&](std::uint32_t n) -> const Atom& {
    return n < own ? structure.atoms[n] : structure.extra_atoms[n - own];
  };
  std::vector<std::uint32_t> places;
  std::vector<Atom> shown;
  for (std::uint32_t n = 0; n < own + structure.extra_atoms.size(); ++n) {
    if (atom(n).shown == 0) continue;
    places.push_back(n);
    shown.push_back(atom(n));
  }
  std::vector<Bond> bonds = bonds_in_any_order(shown, contents.bonds, contents.fully_bonded);
  for (auto& [a, b] : bonds) {
    a = places[a];
    b = places[b];
  }
  return bonds;
}

void refuse_no_atoms(const Structure& structure) {
  if (!structure.atoms.empty()) return;
  throw InputError(structure.file, 0,
                   message("no atoms are left to make a surface of: {}; add @keep-water@ or @keep-ions@ to use them",
                           structure.report.sentence()));
}

/// Throws InputError if elements are unknown. why: FileContents::unknown_elements.
void halt_on_unknown_elements(const Structure& structure, const std::vector<std::string>& unknown,
                              const std::string& why) {
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
  if (martini_version(structure.atoms).number != 0)
    throw InputError(structure.file, 0,
                     message("the type of {} {} is unknown: {}; give {} radius by @radius 'resname NAME=2.64'@, or "
                             "choose @unknown-element guess@",
                             with_thousands(unknown.size()), unknown.size() == 1 ? "bead" : "beads", examples,
                             unknown.size() == 1 ? "its" : "their"));
  const std::string advice = message("correct the element column, or choose @unknown-element guess@ or skip");
  throw InputError(structure.file, 0, "the element of {} {} is unknown: {}; {}", with_thousands(unknown.size()),
                   unknown.size() == 1 ? "atom" : "atoms", examples, why.empty() ? advice : why);
}

void require_model(const std::string& path, const ModelChoice& choice, std::size_t models) {
  if (choice.all || static_cast<std::size_t>(choice.number) <= models) return;
  throw InputError(path, 0,
                   message("has no model {}: it holds {} {}; choose @model@ 1{}", choice.number, models,
                           models == 1 ? "model" : "models", models == 1 ? "" : fmt::format(" to {}", models)));
}

void warn_of_missing_altloc(Structure& structure, const std::vector<Atom>& atoms, const AltlocChoice& choice) {
  if (choice.rule != AltlocChoice::Rule::letter) return;
  if (std::any_of(atoms.begin(), atoms.end(), [&](const Atom& atom) { return atom.altloc == choice.letter; })) return;
  structure.report.warnings.emplace_back(
      fmt::format("no atom has the alternate location {}; the best one of each residue is used", choice.letter));
}

/// Removes the atoms and bonds that a trajectory does not have. The places of the others are counted again.
void keep_trajectory_atoms(FileContents& contents, const Selection& selection, const TextFile& file,
                           ReadReport& report) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(file.path, 0, message("@trajectory-atoms {}@: {}", in_quotes(selection.text()), what));
  };
  if (selection.uses_radius()) refuse("'radius' cannot be used here: radii are assigned later");
  if (contents.without_positions && selection.uses_positions())
    refuse("this file has no positions; select by names, residues or classes");
  const std::vector<bool> is_kept = selection.evaluate(contents.atoms);
  constexpr std::uint32_t kGone = 0xffffffffu;
  std::vector<std::uint32_t> place(contents.atoms.size(), kGone);
  std::uint32_t kept = 0;
  for (std::uint32_t n = 0; n < contents.atoms.size(); ++n)
    if (is_kept[n]) place[n] = kept++;
  if (kept == 0)
    refuse(fmt::format("selects none of {} atoms; {}", with_thousands(contents.atoms.size()),
                       selection.why_none(contents.atoms)));
  if (kept < contents.atoms.size()) report.excluded[kExcludedTrajectory] = contents.atoms.size() - kept;
  std::vector<bool> sites;
  for (std::size_t n = 0; n < contents.sites.size(); ++n)
    if (is_kept[n]) sites.push_back(contents.sites[n]);
  contents.sites = std::move(sites);
  std::erase_if(contents.atoms, [&](const Atom& atom) { return place[atom.index] == kGone; });
  for (Atom& atom : contents.atoms) atom.index = place[atom.index];
  std::erase_if(contents.bonds, [&](const Bond& bond) { return place[bond[0]] == kGone || place[bond[1]] == kGone; });
  for (Bond& bond : contents.bonds)
    for (std::uint32_t& end : bond) end = place[end];
}

/// Sets the positions of a topology to the positions in the options.
void place_atoms(FileContents& contents, const ReadOptions& options, const TextFile& file) {
  if (!contents.without_positions) return;
  if (options.positions.empty())
    throw InputError(file.path, 0,
                     message("lists atoms without coordinates; add @trajectory@ with a file that has them"));
  if (options.positions.size() != contents.atoms.size())
    throw InputError(file.path, 0, "lists {} atoms, but a frame of the trajectory has {}: {}",
                     with_thousands(contents.atoms.size()), with_thousands(options.positions.size()),
                     advice_on_count(contents.atoms, options.positions.size()));
  for (std::size_t n = 0; n < contents.atoms.size(); ++n) contents.atoms[n].position = options.positions[n];
}

/// Lists all assemblies. If their records are broken, a warning is added.
void list_assemblies(Structure& structure, const TextFile& file, const Reader& reader) {
  try {
    if (reader.assemblies) structure.assemblies = reader.assemblies(file);
  } catch (const InputError& error) {
    structure.report.warnings.push_back(std::string("its assemblies cannot be read: ") + error.what());
  }
}

/// Returns the requested assembly, or nothing.
std::optional<Assembly> requested_assembly(const TextFile& file, const Reader& reader, const ReadOptions& options) {
  if (options.assembly.empty()) return {};
  if (!reader.assemblies)
    throw InputError(file.path, 0,
                     message("is {}, which describes no assemblies; leave @assembly@ out", reader.metadata.name));
  return find_assembly(reader.assemblies(file), options.assembly, file.path);
}

/// True if a selection distinguishes copies, so that copies must be made before atoms are selected.
bool names_copies(const ReadOptions& options) {
  const auto of_some = [](const auto& each) { return each.atoms.names_copies(); };
  return options.copy_mode == CopyMode::atoms &&
         ((options.selection && options.selection->names_copies()) || std::ranges::any_of(options.shown, of_some) ||
          std::ranges::any_of(options.radii.overrides, of_some));
}

/// Makes the copies of all atoms. They count as atoms that were read.
void copy_atoms(std::vector<Atom>& atoms, const Assembly& assembly, Structure& structure) {
  const std::size_t of_file = atoms.size();
  structure.atoms = std::move(atoms);
  assemble(structure, assembly, CopyMode::atoms);
  atoms = std::exchange(structure.atoms, {});
  structure.report.read += atoms.size() + structure.report.excluded[kExcludedAssembly] - of_file;
  std::erase_if(structure.report.excluded, [](const auto& reason) { return reason.second == 0; });
}

/// Converts bonds from Atom::index to places in Structure::atoms followed by `extra_atoms`. Only bonds between shown
/// atoms are returned.
std::vector<Bond> bonds_by_place(const Structure& structure, const std::vector<Bond>& by_index) {
  std::unordered_map<std::uint32_t, std::uint32_t> places;
  std::uint32_t next = 0;
  for (const std::vector<Atom>* atoms : {&structure.atoms, &structure.extra_atoms})
    for (const Atom& atom : *atoms) places.emplace(atom.index, next++);
  std::vector<Bond> bonds;
  for (const auto& [a, b] : by_index) {
    const auto first = places.find(a), second = places.find(b);
    if (first != places.end() && second != places.end()) bonds.push_back({first->second, second->second});
  }
  return bonds;
}

}  // namespace

/// The contents of a file, which is read once.
struct StructureFile::Parts {
  Parts(const std::string& path, const ReadOptions& read_options)
      : options(read_options),
        file(read_molecule_file(path)),
        reader(choose_reader(file)),
        contents(reader.read(file, read_options.model)) {
    require_model(file.path, options.model, contents.models);
    report.models = contents.models;
    if (options.trajectory_atoms) keep_trajectory_atoms(contents, *options.trajectory_atoms, file, report);
    place_atoms(contents, options, file);
    if (options.keep_topology)
      topology = std::make_shared<const Topology>(Topology{contents.atoms, contents.bonds, contents.without_positions});
    add_files();
    if (!options.selection && !options.takes_ligands) outside = outside_polymer(contents.atoms, contents.bonds);
    report.read = report.excluded[kExcludedTrajectory] + contents.atoms.size() + contents.other_model_atoms;
    report.excluded[kExcludedModel] = contents.other_model_atoms;
    std::erase_if(report.excluded, [](const auto& reason) { return reason.second == 0; });
    report.warnings = contents.warnings;
    warn_of_other_molecules();
    chains = chains_of(contents.atoms);
    radii.emplace(options.radii, file.path, contents.radii, contents.atoms);
    warn_of_uncertain_martini();
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void warn_of_other_molecules() {
    if (!contents.of_molecules || contents.models < 2 || options.model.all || options.model.number != 1) return;
    report.warnings.emplace_back(
        message("{} molecules are in the file; the first is used, @model 2@ takes the next, @model all@ unites them",
                with_thousands(contents.models)));
  }

  void warn_of_uncertain_martini() {
    const MartiniVersion martini = martini_version(contents.atoms);
    if (martini.number == 0 || martini.is_certain || !options.radii.set.empty()) return;
    report.warnings.emplace_back(
        message("the names do not show whether this is Martini 2 or 3; types and radii of Martini 3 are used; for "
                "Martini 2 add @radii martini2@"));
  }

  void add_files() {
    if (options.added.empty()) {
      if (options.superpose_on)
        throw RequestError(message("@superpose-on@ superposes the files of @add@, and there are none"));
      return;
    }
    if (!options.assembly.empty())
      throw RequestError(message("@add@ and @assembly@ cannot be combined: write the assembly to a file and add that"));
    added.emplace(file.path, options.added, options.model, options.superpose_on, contents);
  }

  /// Makes a structure of atoms, which are those of the contents at any positions. Structure::shown_bonds stays empty.
  Structure choose(std::vector<Atom> atoms, PositionScope scope) const {
    Structure structure;
    structure.file = file.path;
    structure.format = reader.metadata.name;
    structure.experiment = contents.experiment;
    structure.report = report;
    structure.topology = topology;
    if (added) structure.added = added->place(atoms);
    structure.chains = chains;
    const std::optional<Assembly> assembly = requested_assembly(file, reader, options);
    const bool copies_first = assembly && names_copies(options);
    if (copies_first) copy_atoms(atoms, *assembly, structure);
    warn_of_missing_altloc(structure, atoms, options.altloc);
    if (std::ranges::find(outside.drawn, true) != outside.drawn.end())
      structure.companions = std::max(options.companions, Companions::hidden);
    choose_atoms(atoms, contents.sites, outside, structure.extra_atoms, options, *radii, structure.report, file.path,
                 scope);
    structure.atoms = std::move(atoms);
    structure.report.used = structure.atoms.size();
    refuse_no_atoms(structure);
    std::vector<std::string> unknown = radii->assign(structure);
    const std::vector<std::string> extra_unknown = assign_extra_radii(structure, *radii);
    unknown.insert(unknown.end(), extra_unknown.begin(), extra_unknown.end());
    if (options.unknown_element == UnknownElement::halt && scope != PositionScope::any)
      halt_on_unknown_elements(structure, unknown, contents.unknown_elements);
    refuse_no_atoms(structure);
    warn_of_coincident_atoms(structure);
    if (options.model.all && contents.models > 1 && !added) warn_of_overlaid_models(structure);
    if (contents.radii != FileRadii::usual) warn_of_wrong_unit(structure);
    if (options.list_assemblies) list_assemblies(structure, file, reader);
    if (assembly && !copies_first) {
      assemble(structure, *assembly, options.copy_mode);
      assemble_extra_atoms(structure, *assembly);
    }
    return structure;
  }

  const ReadOptions options;
  TextFile file;
  const Reader& reader;
  FileContents contents;
  std::optional<AddedFiles> added;
  OutsidePolymer outside;  ///< empty lists if atoms are selected
  ReadReport report;
  std::shared_ptr<const Topology> topology;
  std::optional<RadiiChoice> radii;
  std::vector<std::string> chains;   ///< becomes Structure::chains
  std::vector<Bond> bonds_by_index;  ///< bonds of all atoms that may be shown, by Atom::index
};

StructureFile::StructureFile(const std::string& path, const ReadOptions& options)
    : parts_(std::make_unique<Parts>(path, options)),
      possible_structure_(parts_->choose(parts_->contents.atoms, PositionScope::any)) {
  if (!marks_atoms(options)) return;
  possible_structure_.shown_bonds =
      std::make_shared<const std::vector<Bond>>(find_shown_bonds(possible_structure_, parts_->contents));
  const std::size_t own = possible_structure_.atoms.size();
  const auto index = [&](std::uint32_t n) {
    return (n < own ? possible_structure_.atoms[n] : possible_structure_.extra_atoms[n - own]).index;
  };
  for (const auto& [a, b] : *possible_structure_.shown_bonds) parts_->bonds_by_index.push_back({index(a), index(b)});
}

StructureFile::~StructureFile() = default;

Structure StructureFile::at(std::span<const glm::dvec3> positions) const {
  std::vector<Atom> atoms = parts_->contents.atoms;
  for (std::size_t n = 0; n < positions.size(); ++n) atoms[n].position = positions[n];
  Structure structure = parts_->choose(std::move(atoms), PositionScope::frame);
  if (marks_atoms(parts_->options))
    structure.shown_bonds =
        std::make_shared<const std::vector<Bond>>(bonds_by_place(structure, parts_->bonds_by_index));
  return structure;
}

std::size_t count_atoms(const std::string& path, const std::optional<Selection>& trajectory_atoms) {
  const TextFile file = read_molecule_file(path);
  FileContents contents = choose_reader(file).read(file, {});
  ReadReport unused;
  if (trajectory_atoms) keep_trajectory_atoms(contents, *trajectory_atoms, file, unused);
  return contents.atoms.size();
}

Structure read_structure(const std::string& path, const ReadOptions& options) {
  StructureFile::Parts parts(path, options);
  Structure structure = parts.choose(std::move(parts.contents.atoms), PositionScope::current);
  if (marks_atoms(options))
    structure.shown_bonds = std::make_shared<const std::vector<Bond>>(find_shown_bonds(structure, parts.contents));
  return structure;
}

}  // namespace meniscus
