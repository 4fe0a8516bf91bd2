// SPDX-License-Identifier: BSD-3-Clause
// Holds the built-in sets of radii (bondi, protor, united, Martini), and assigns radii: atoms with the same names and
// element are looked up once.
#include "core/structure/radii/assign_radii.h"

#include <algorithm>
#include <tuple>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/element_tables.h"
#include "core/structure/martini.h"
#include "core/structure/residue_names.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

constexpr const RadiiSet* kSets[] = {&kBondiSet, &kUnitedSet, &kProtorSet, &kMartini2Set, &kMartini3Set};

}  // namespace

std::span<const RadiiSet* const> radii_sets() { return kSets; }

const RadiiSet* find_radii_set(std::string_view name) {
  for (const RadiiSet* set : kSets) {
    if (set->name == name) return set;
  }
  return nullptr;
}

std::string radii_set_names() {
  std::string names;
  for (const RadiiSet* set : kSets) names += std::string(set->name) + ", ";
  return names + "file";
}

const RadiiSet kBondiSet{"bondi", "by element; hydrogens are atoms of their own", "Bondi 1964, 1966", false,
                         [](const Atom& atom) -> std::optional<FoundRadius> {
                           const ElementRadius found = bondi_radius(atom.element);
                           return FoundRadius{found.radius,
                                              atom.element == 0 ? "unknown" : element_symbol(atom.element),
                                              source_name(found.source)};
                         }};

// Radii by bonding class from J. Tsai, R. Taylor, C. Chothia & M. Gerstein, J. Mol. Biol. 290, 253 (1999).

namespace {

constexpr const char* kPaper = "Tsai et al. 1999, J. Mol. Biol. 290, 253";
constexpr const char* kExtension = "FreeSASA's extension of Tsai et al. 1999";

struct Entry {
  double radius;  // Å
  const char* source;
};

// The paper covers proteins. S. Mitternacht, F1000Research 5, 189 (2016) adds nucleotides, selenium and water.
const std::map<std::string_view, Entry> kProtorRadii{
    {"C3H0", {1.61, kPaper}},     {"C3H1", {1.76, kPaper}},      {"C4H1", {1.88, kPaper}},
    {"C4H2", {1.88, kPaper}},     {"C4H3", {1.88, kPaper}},      {"N3H0", {1.64, kPaper}},
    {"N3H1", {1.64, kPaper}},     {"N3H2", {1.64, kPaper}},      {"N4H3", {1.64, kPaper}},
    {"O1H0", {1.42, kPaper}},     {"O2H1", {1.46, kPaper}},      {"S2H0", {1.77, kPaper}},
    {"S2H1", {1.77, kPaper}},     {"P4H0", {1.80, kExtension}},  {"O2H0", {1.46, kExtension}},
    {"O2H2", {1.46, kExtension}}, {"SE2H1", {1.90, kExtension}}, {"SE2H0", {1.90, kExtension}},
    {"N2H0", {1.64, kExtension}}};

std::optional<FoundRadius> protor_radius_of(const Atom& atom) {
  const auto found = kProtorRadii.find(bonding_class(atom.residue_name, atom.name));
  if (found == kProtorRadii.end()) return std::nullopt;
  return FoundRadius{found->second.radius, found->first, found->second.source};
}

}  // namespace

const RadiiSet kProtorSet{"protor", "united atoms by bonding class, as FreeSASA uses them", kPaper, true,
                          protor_radius_of};

// Radii of C. Chothia, J. Mol. Biol. 105, 1 (1976), for proteins. In nucleotides they apply to atoms of the same kinds.

namespace {

// Radii in Å of tetrahedral and trigonal carbon, amide and amino nitrogen, oxygen, and sulphur. The paper has no radius
// for phosphorus and selenium.
const std::map<std::string_view, double> kUnitedRadii{{"C4", 1.87}, {"C3", 1.76}, {"N4", 1.50}, {"N3", 1.65},
                                                      {"N2", 1.65}, {"O1", 1.40}, {"O2", 1.40}, {"S2", 1.85}};

std::optional<FoundRadius> united_radius_of(const Atom& atom) {
  const std::string_view bonding = bonding_class(atom.residue_name, atom.name);
  const auto found = kUnitedRadii.find(bonding.substr(0, 2));
  if (found == kUnitedRadii.end()) return std::nullopt;
  return FoundRadius{found->second, bonding, kUnitedSet.source};
}

}  // namespace

const RadiiSet kUnitedSet{"united", "united atoms: hydrogens are part of the atoms that carry them",
                          "Chothia 1976, J. Mol. Biol. 105, 1", true, united_radius_of};

// The radius of a bead is half the distance at the energy minimum of two equal beads. Areas of Martini are measured
// with the same radius.

namespace {

std::optional<FoundRadius> bead_radius(const Atom& atom, int version, std::string_view source) {
  if (atom.element != 0) return std::nullopt;
  const std::optional<Bead> bead = martini_bead(atom.residue_name, atom.name, version);
  if (!bead) return std::nullopt;
  return FoundRadius{bead->radius, bead->type, source};
}

constexpr const char* kMartini2Source = "Marrink et al. 2007, J. Phys. Chem. B 111, 7812";
constexpr const char* kMartini3Source = "Souza et al. 2021, Nat. Methods 18, 382";

}  // namespace

const RadiiSet kMartini2Set{"martini2", "beads of Martini 2: half the distance of their energy minimum",
                            kMartini2Source, false,
                            [](const Atom& atom) { return bead_radius(atom, 2, kMartini2Source); }};
const RadiiSet kMartini3Set{"martini3", "beads of Martini 3, the same", kMartini3Source, false,
                            [](const Atom& atom) { return bead_radius(atom, 3, kMartini3Source); }};

namespace {

bool is_explicit_hydrogen(const Atom& atom) { return atom.element == 1; }

const char* atoms_word(std::size_t count) { return count == 1 ? "atom" : "atoms"; }

void warn_of_elements_without_source(Structure& structure, const std::map<std::uint8_t, std::size_t>& elements) {
  if (elements.empty()) return;
  std::string list;
  for (const auto& [element, count] : elements) {
    list += fmt::format("{}{} ({} {})", list.empty() ? "" : ", ", element_symbol(element), with_thousands(count),
                        atoms_word(count));
  }
  structure.report.warnings.emplace_back(
      fmt::format("no published van der Waals radius for {}; {:.1f} Å is used", list, kRadiusWithoutSource));
}

}  // namespace

RadiusOverride parse_radius_override(const std::string& text) {
  const std::size_t sign = text.rfind('=');
  double radius = 0.0;
  if (sign == std::string::npos)
    throw SelectionError("a radius is missing; write EXPR=RADIUS, as in 'element Zn=1.1'",
                         pointed_at(text, text.size()));
  if (!parse_number(std::string_view(text).substr(sign + 1), radius) || radius <= 0.0 || radius > kLargestRadius)
    throw SelectionError(fmt::format("the radius must be a number of Å above 0, at most {}", kLargestRadius),
                         pointed_at(text, sign + 1));
  return {parse_selection(std::string_view(text).substr(0, sign)), radius};
}

RadiiChoice::RadiiChoice(const RadiiOptions& options, const std::string& molecule_file, FileRadii file_radii,
                         std::span<const Atom> atoms)
    : options_(options), tables_(read_radii_files(options.files)) {
  if (options.set.empty()) {
    from_file_ = file_radii == FileRadii::usual && tables_.empty();
  } else if (options.set == "file") {
    if (file_radii == FileRadii::none)
      throw InputError(molecule_file, 0, "holds no radii; choose another set: " + radii_set_names());
    from_file_ = true;
  } else {
    set_ = find_radii_set(options.set);
    if (!set_)
      throw InputError(molecule_file, 0, "{} is not a set of radii; choose one of {}", in_quotes(options.set),
                       radii_set_names());
  }
  if (from_file_) return;
  const MartiniVersion martini = martini_version(atoms);
  if (martini.number != 0 && options.set.empty()) set_ = martini.number == 2 ? &kMartini2Set : &kMartini3Set;
  if (martini.number != 0 && set_ != &kMartini2Set && set_ != &kMartini3Set)
    throw InputError(
        molecule_file, 0,
        message("holds beads of Martini, for which {} has no radii; choose martini2 or martini3, or leave @radii@ out",
                set_->name));
  refuse_covering_none(molecule_file, atoms);
}

/// Throws InputError if no atom has a radius of the chosen set or files. There is no error with overrides, because they
/// may be all that the user wants.
void RadiiChoice::refuse_covering_none(const std::string& molecule_file, std::span<const Atom> atoms) const {
  const auto is_covered = [this](const Atom& atom) { return radius_for(atom, true).is_covered; };
  if (atoms.empty() || options_.may_cover_none || !options_.overrides.empty() || std::ranges::any_of(atoms, is_covered))
    return;
  throw InputError(molecule_file, 0,
                   message("{} has a radius for none of its {} {}; choose other radii by @radii@", name(),
                           with_thousands(atoms.size()), atoms_word(atoms.size())));
}

bool RadiiChoice::united(bool any_hydrogens) const {
  if (from_file_ || !any_hydrogens) return false;
  const bool tables_united =
      std::all_of(tables_.begin(), tables_.end(), [](const auto& table) { return table.united(); });
  return tables_.empty() || !options_.set.empty() ? set_->united && tables_united : tables_united;
}

RadiiChoice::Given RadiiChoice::radius_for(const Atom& atom, bool hydrogens_used) const {
  for (auto table = tables_.rbegin(); table != tables_.rend(); ++table) {
    if (const auto found = table->find(atom, hydrogens_used)) return {*found};
  }
  if (from_file_) return {{atom.radius, element_symbol(atom.element), "the molecule file"}};
  if (const auto found = set_->radius_of(atom)) return {*found, tables_.empty() || set_ != &kBondiSet};
  if (atom.element == 0 && (set_ == &kMartini2Set || set_ == &kMartini3Set))
    return {{kRadiusWithoutSource, "unknown", source_name(RadiusSource::none)}};
  return {*kBondiSet.radius_of(atom), false};
}

std::vector<RadiiChoice::Given> RadiiChoice::radii_for(const Structure& structure, bool hydrogens_used) const {
  std::vector<Given> given;
  given.reserve(structure.atoms.size());
  std::unordered_map<std::string, Given> known;
  std::string key;
  for (const Atom& atom : structure.atoms) {
    if (from_file_) {  // each atom has its own radius
      given.push_back(radius_for(atom, hydrogens_used));
      continue;
    }
    key = atom.residue_name;
    key += '\n';
    key += atom.name;
    key += '\n';
    key += static_cast<char>(atom.element);
    const auto [found, added] = known.try_emplace(key);
    if (added) found->second = radius_for(atom, hydrogens_used);
    given.push_back(found->second);
  }
  return given;
}

void RadiiChoice::override_radii(Structure& structure, std::vector<Given>& given) const {
  for (const RadiusOverride& replacement : options_.overrides) {
    const std::vector<bool> selected = replacement.atoms.evaluate(structure.atoms);
    if (std::find(selected.begin(), selected.end(), true) == selected.end()) {
      structure.report.warnings.emplace_back(fmt::format("the radius of {} Å is not used: no atom is selected by {}",
                                                         replacement.radius, in_quotes(replacement.atoms.text())));
    }
    for (std::size_t n = 0; n < given.size(); ++n) {
      if (!selected[n]) continue;
      given[n] = {{replacement.radius, replacement.atoms.text(), "given for this run"}, true};
      structure.atoms[n].radius = replacement.radius;
    }
  }
}

void RadiiChoice::warn(Structure& structure, const std::vector<Given>& given) const {
  std::map<std::uint8_t, std::size_t> without_source;
  std::vector<std::string> uncovered;
  std::size_t hydrogens = 0;
  for (std::size_t n = 0; n < given.size(); ++n) {
    const Atom& atom = structure.atoms[n];
    if (!given[n].is_covered) uncovered.push_back(label_of(atom));
    if (is_explicit_hydrogen(atom)) ++hydrogens;
    const bool by_element = !given[n].is_covered || set_ == &kBondiSet;
    if (by_element && given[n].found.source == source_name(RadiusSource::none)) ++without_source[atom.element];
  }
  if (!uncovered.empty()) {
    std::string sentence =
        fmt::format("{} gives no radius to {} {}; Bondi's of the element is used (first: {})", name(),
                    with_thousands(uncovered.size()), atoms_word(uncovered.size()), uncovered.front());
    structure.report.warnings.emplace_back(std::move(sentence), std::move(uncovered));
  }
  if (hydrogens > 0 && united(true)) {
    structure.report.warnings.emplace_back(
        fmt::format("{} {} used with radii of united atoms ({}), which already include them; drop the hydrogens or "
                    "choose radii for explicit ones",
                    with_thousands(hydrogens), hydrogens == 1 ? "hydrogen is" : "hydrogens are", name()));
  }
  warn_of_elements_without_source(structure, without_source);
}

std::string RadiiChoice::name() const {
  std::string names;
  const auto add = [&names](const std::string& part) { names += (names.empty() ? "" : ", ") + part; };
  for (const RadiiTable& table : tables_) add(table.source());
  if (from_file_) {
    add("file");
  } else if (tables_.empty() || set_ != &kBondiSet) {
    add(std::string(set_->name));
  }
  for (const RadiusOverride& change : options_.overrides)
    add(fmt::format("{} = {} Å", escaped(change.atoms.text()), change.radius));
  return names;
}

std::vector<std::string> RadiiChoice::assign(Structure& structure) const {
  const bool hydrogens_used = std::any_of(structure.atoms.begin(), structure.atoms.end(), is_explicit_hydrogen);
  std::vector<Given> given = radii_for(structure, hydrogens_used);
  for (std::size_t n = 0; n < given.size(); ++n) structure.atoms[n].radius = given[n].found.radius;
  override_radii(structure, given);
  warn(structure, given);
  structure.radii_set = name();

  std::vector<std::string> unknown;
  std::map<std::tuple<std::string_view, double, std::string_view>, std::size_t> classes;
  std::size_t kept = 0;
  for (std::size_t n = 0; n < given.size(); ++n) {
    Atom& atom = structure.atoms[n];
    const bool guessed = !from_file_ && atom.element == 0 && given[n].found.label == "unknown";
    if (guessed) unknown.push_back(label_of(atom));
    if (atom.radius == 0.0) {
      ++structure.report.excluded[kExcludedRadius];
      continue;
    }
    ++classes[{given[n].found.label, atom.radius, given[n].found.source}];
    if (kept != n) structure.atoms[kept] = std::move(atom);
    ++kept;
  }
  structure.atoms.resize(kept);
  structure.report.used = kept;
  for (const auto& [what, count] : classes) {
    const auto& [label, radius, source] = what;
    structure.radius_classes.push_back({std::string(label), radius, std::string(source), count});
  }
  return unknown;
}

}  // namespace meniscus
