// SPDX-License-Identifier: BSD-3-Clause
// Sorts atoms into the classes of secondary structure, of confidence, of sugars and of beads.
#include "core/color/ordered_classes.h"

#include <cmath>

#include "core/structure/element_tables.h"
#include "core/structure/martini.h"
#include "core/structure/secondary_structure.h"
#include "core/structure/sugars.h"

namespace meniscus {
namespace {

struct Row {
  std::string_view name;
  std::uint32_t color;
};

/// Returns the place of a class in a result, to which it is added if it is new.
std::uint8_t place_of(const Row& row, ClassedAtoms& result) {
  const auto found = std::ranges::find(result.classes, row.name, &ColorClass::name);
  const auto place = static_cast<std::uint8_t>(found - result.classes.begin());
  if (found == result.classes.end()) result.classes.push_back({std::string(row.name), color_from_hex(row.color)});
  return place;
}

constexpr std::array<Row, 4> kSecondary{
    {{"helix", 0xd55e00}, {"strand", 0xf0e442}, {"coil", 0xcccccc}, {"other", 0x56b4e9}}};

// The colours of the AlphaFold database.
constexpr std::array<Row, 4> kConfidence{{{"very high (> 90)", 0x0053d6},
                                          {"confident (70 to 90)", 0x65cbf3},
                                          {"low (50 to 70)", 0xffdb13},
                                          {"very low (< 50)", 0xff7d45}}};
constexpr std::array<float, 3> kLimits{90.0f, 70.0f, 50.0f};
constexpr std::uint32_t kWithout = 0x808080;

bool has_own_confidence(const Structure& structure) {
  return std::ranges::any_of(structure.atoms, [](const Atom& atom) { return !std::isnan(atom.confidence); });
}

}  // namespace

ClassedAtoms secondary_classes(const Structure& structure) {
  const std::vector<SecondaryStructure> kinds = secondary_structure(structure.atoms);
  std::vector<std::size_t> rows;
  std::array<bool, kSecondary.size()> occurs{};
  for (std::size_t a = 0; a < kinds.size(); ++a) {
    const Atom& atom = structure.atoms[a];
    const bool is_protein = atom.kind != AtomClass::water && atom.kind != AtomClass::ion &&
                            atom.kind != AtomClass::ligand && !std::isnan(hydropathy(atom.residue_name));
    rows.push_back(kinds[a] == SecondaryStructure::helix    ? 0
                   : kinds[a] == SecondaryStructure::strand ? 1
                   : is_protein                             ? 2
                                                            : 3);
    occurs[rows.back()] = true;
  }
  ClassedAtoms result;
  for (std::size_t n = 0; n < kSecondary.size(); ++n)
    if (occurs[n]) place_of(kSecondary[n], result);
  for (const std::size_t row : rows) result.of_atom.push_back(place_of(kSecondary[row], result));
  return result;
}

ClassedAtoms confidence_classes(const Structure& structure) {
  ClassedAtoms result;
  for (const Row& row : kConfidence) place_of(row, result);
  const bool own = has_own_confidence(structure);
  std::size_t without = 0;
  for (const Atom& atom : structure.atoms) {
    const float number = own ? atom.confidence : atom.b_factor;
    const auto limit = std::ranges::find_if(kLimits, [&](float least) { return number > least; });
    if (std::isnan(number)) ++without;
    result.of_atom.push_back(
        static_cast<std::uint8_t>(std::isnan(number) ? kConfidence.size() : limit - kLimits.begin()));
  }
  if (without == structure.atoms.size())
    throw InputError(
        structure.file, 0,
        message(
            "has neither B-factors nor a table _ma_qa_metric_local, so no pLDDT to colour by; choose another @color@"));
  if (without > 0) result.classes.push_back({std::string(kWithoutConfidence), color_from_hex(kWithout)});
  return result;
}

namespace {

constexpr Row kOther{"other", 0xb4b4b4}, kWhiteHalf{"white half", 0xf5f5f5};

// The order of these rows is that of BeadClass.
constexpr std::array<Row, 6> kBeads{{{"charged", 0xd55e00},
                                     {"polar", 0x56b4e9},
                                     {"intermediate", 0x009e73},
                                     {"apolar", 0xe6d9b8},
                                     {"water", 0x0072b2},
                                     {"backbone", 0xf0e442}}};

/// Returns each sugar that occurs, by its symbol (core/structure/sugars.h). For sugars with a half white symbol, atoms
/// outside the ring are in the class "white half"; atoms outside sugars are in "other".
ClassedAtoms sugar_classes(const Structure& structure) {
  ClassedAtoms result;
  const std::span<const Atom> atoms(structure.atoms);
  std::size_t last = 0;
  for (std::size_t first = 0; first < atoms.size(); first = last) {
    while (last < atoms.size() && atoms[last].residue == atoms[first].residue && atoms[last].copy == atoms[first].copy)
      ++last;
    const std::span<const Atom> residue = atoms.subspan(first, last - first);
    const Sugar* const sugar = sugar_of(residue);
    if (!sugar) {
      result.of_atom.insert(result.of_atom.end(), residue.size(), place_of(kOther, result));
      continue;
    }
    result.of_atom.insert(result.of_atom.end(), residue.size(), place_of({sugar->name, sugar->color}, result));
    if (!sugar->is_divided()) continue;
    const SugarRing ring = ring_of(residue);
    const auto in_ring = [&](std::size_t n) {
      return std::find(ring.atoms.begin(), ring.atoms.begin() + ring.count, n) != ring.atoms.begin() + ring.count;
    };
    for (std::size_t n = 0; n < residue.size(); ++n)
      if (!in_ring(n)) result.of_atom[first + n] = place_of(kWhiteHalf, result);
  }
  return result;
}

/// Returns the classes of Martini's beads that occur: "charged", "polar", "intermediate", "apolar", "water"; "backbone"
/// of Martini 2, where it depends on the fold; "other" for atoms that are not beads.
ClassedAtoms bead_classes(const Structure& structure) {
  ClassedAtoms result;
  const MartiniVersion version = martini_version(structure.atoms);
  std::vector<std::optional<Bead>> beads;
  std::array<bool, kBeads.size()> occurs{};
  for (const Atom& atom : structure.atoms) {
    const bool may_be = version.number != 0 && atom.element == 0;
    beads.push_back(may_be ? martini_bead(atom.residue_name, atom.name, version.number) : std::nullopt);
    if (beads.back()) occurs[static_cast<std::size_t>(beads.back()->kind)] = true;
  }
  for (std::size_t n = 0; n < kBeads.size(); ++n)
    if (occurs[n]) place_of(kBeads[n], result);
  for (const std::optional<Bead>& bead : beads)
    result.of_atom.push_back(place_of(bead ? kBeads[static_cast<std::size_t>(bead->kind)] : kOther, result));
  return result;
}

}  // namespace

bool has_ordered_classes(ColorScheme::By by) { return by >= ColorScheme::By::secondary && by <= ColorScheme::By::bead; }

ClassedAtoms ordered_classes(const Structure& structure, ColorScheme::By by) {
  switch (by) {
    case ColorScheme::By::plddt:
      return confidence_classes(structure);
    case ColorScheme::By::snfg:
      return sugar_classes(structure);
    case ColorScheme::By::bead:
      return bead_classes(structure);
    default:
      return secondary_classes(structure);
  }
}

std::string_view source_of_confidence(const Structure& structure) {
  return has_own_confidence(structure) ? "_ma_qa_metric_local" : "B-factors";
}

std::optional<std::string> doubt_of_confidence(const Structure& structure) {
  if (has_own_confidence(structure)) return {};
  std::size_t beyond = 0;
  float largest = 0.0f;
  const Atom* first = nullptr;
  for (const Atom& atom : structure.atoms) {
    if (std::isnan(atom.b_factor)) continue;
    largest = std::max(largest, atom.b_factor);
    if (atom.b_factor >= 0.0f && atom.b_factor <= 100.0f) continue;
    if (beyond++ == 0) first = &atom;
  }
  if (first)
    return message(
        "@color plddt@ takes B-factors as pLDDT, from 0 to 100, but {} {} outside this range (first: {} with {:g}); "
        "for B-factors use @color bfactor@",
        with_thousands(beyond), beyond == 1 ? "atom is" : "atoms are", label_of(*first), first->b_factor);
  if (!structure.experiment.empty())
    return message(
        "@color plddt@ takes B-factors as pLDDT, but this structure was determined by experiment ({}); for B-factors "
        "use @color bfactor@",
        structure.experiment);
  if (largest <= 1.0f)
    return message(
        "@color plddt@ takes B-factors as pLDDT, from 0 to 100, but all are at most 1; if they are fractions, multiply "
        "them by 100");
  return {};
}

}  // namespace meniscus
