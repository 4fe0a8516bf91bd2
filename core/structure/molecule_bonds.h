// SPDX-License-Identifier: BSD-3-Clause
// Every bond of a structure as a picture shows it: listed by the file, of standard residues, or near enough.
#pragma once

#include <span>
#include <vector>

#include "core/structure/structure.h"

namespace meniscus {

/// The bonds between these atoms, as places in `atoms`, lower place first, each once and ascending: those of `listed`
/// (by Atom::index; in an assembly, those of each copy), template_bonds, and by distance wherever an atom is in no
/// standard residue: no farther apart than the covalent radii (B. Cordero et al., Dalton Trans. 2008, 2832) and 0.4 Å;
/// between standard residues, as in disulphides and cross-links, 0.2 Å. No distance binds two hydrogens, a free ion, an
/// atom of unknown element, or what stands within 0.5 Å, which are duplicates. Never across models, copies, or
/// alternate locations: of two atoms with different letters, not if one residue has both of them or either has several.
/// Nothing longer than kLongestBond, which crosses a periodic box. O(n) for molecules.
std::vector<Bond> molecule_bonds(std::span<const Atom> atoms, std::span<const Bond> listed);

inline constexpr double kLongestBond = 4.0;  ///< Å; those of caesium to ligands are 3.3 Å long

}  // namespace meniscus
