// SPDX-License-Identifier: BSD-3-Clause
// United-atom radii of C. Chothia, J. Mol. Biol. 105, 1 (1976), for proteins; nucleotides by the same kinds of atoms.
#include <map>

#include "core/structure/bonding_classes.h"
#include "core/structure/radii/radii_set.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

// Å. Tetrahedral and trigonal carbon, amide and amino nitrogen, oxygen, sulphur. The paper gives no radius for
// phosphorus and selenium.
const std::map<std::string_view, double> kRadii{{"C4", 1.87}, {"C3", 1.76}, {"N4", 1.50}, {"N3", 1.65},
                                                {"N2", 1.65}, {"O1", 1.40}, {"O2", 1.40}, {"S2", 1.85}};

std::optional<FoundRadius> radius_of(const Atom& atom) {
  const std::string_view bonding = bonding_class(atom.residue_name, atom.name);
  const auto found = kRadii.find(bonding.substr(0, 2));
  if (found == kRadii.end()) return std::nullopt;
  return FoundRadius{found->second, bonding, kUnitedSet.source};
}

}  // namespace

const RadiiSet kUnitedSet{"united", "united atoms: hydrogens are part of the atoms that carry them",
                          "Chothia 1976, J. Mol. Biol. 105, 1", true, radius_of};

}  // namespace meniscus
