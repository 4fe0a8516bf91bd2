// SPDX-License-Identifier: BSD-3-Clause
// Holds the built-in sets of radii (bondi, protor, united, Martini), and finds a set by its name.
#include "core/structure/radii/radii_set.h"

#include "core/structure/martini.h"
#include "core/structure/residue_names.h"
#include "core/structure/element_tables.h"
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

}  // namespace meniscus
