// SPDX-License-Identifier: BSD-3-Clause
// Sorts atoms into the classes of secondary structure and of confidence.
#include "core/color/ordered_classes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/named_colors.h"
#include "core/structure/element_tables.h"
#include "core/structure/secondary_structure.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

struct Row {
  const char* name;
  std::uint32_t color;
};

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
  std::array<std::uint8_t, kSecondary.size()> place{};
  for (std::size_t n = 0; n < kSecondary.size(); ++n) {
    if (!occurs[n]) continue;
    place[n] = static_cast<std::uint8_t>(result.classes.size());
    result.classes.push_back({kSecondary[n].name, color_from_hex(kSecondary[n].color)});
  }
  for (const std::size_t row : rows) result.of_atom.push_back(place[row]);
  return result;
}

ClassedAtoms confidence_classes(const Structure& structure) {
  ClassedAtoms result;
  for (const Row& row : kConfidence) result.classes.push_back({row.name, color_from_hex(row.color)});
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
    throw InputError(structure.file, 0,
                     "has neither B-factors nor a table _ma_qa_metric_local, so no pLDDT to colour by; choose another "
                     "--color");
  if (without > 0)
    result.classes.push_back({fmt::format("none ({} atoms)", with_thousands(without)), color_from_hex(kWithout)});
  return result;
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
    return fmt::format(
        "--color plddt takes B-factors for pLDDT, which is from 0 to 100, but {} {} outside of that, the first {} with "
        "{:g}; --color bfactor shows B-factors",
        with_thousands(beyond), beyond == 1 ? "atom is" : "atoms are", label_of(*first), first->b_factor);
  if (!structure.experiment.empty())
    return fmt::format(
        "--color plddt takes B-factors for pLDDT, but this structure is of an experiment ({}); --color bfactor shows "
        "B-factors",
        structure.experiment);
  if (largest <= 1.0f)
    return "--color plddt takes B-factors for pLDDT, which is from 0 to 100, but none is above 1; if they are "
           "shares, multiply them by 100";
  return {};
}

}  // namespace meniscus
