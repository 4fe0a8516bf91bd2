// SPDX-License-Identifier: BSD-3-Clause
// Finds the molecules of a file that do not belong to its polymers: ligands, cofactors, lipids and ions.
#pragma once

#include <span>
#include <vector>

#include "core/structure/structure.h"

namespace meniscus {

/// The molecules of a file outside of its polymers. Both lists have one entry per atom. They are empty if the file has
/// no polymer, because such a file is taken whole.
struct OutsidePolymer {
  /// The classes of molecules. `inside`: polymers and everything that is bound to them, water and ions.
  enum class Part : std::uint8_t { inside, ligand, lipid };

  std::vector<Part> part;
  /// True for atoms of ligands, lipids and ions that pictures draw next to a surface of the polymer. Molecules of one
  /// name are not drawn if a model has more than 20 of them, because they are solvent, salt or a membrane; all lipids
  /// count as one name. Ligands of at least 40 heavy atoms are always drawn. Ions are not drawn in a box of water,
  /// which has more than 10 water molecules per residue.
  std::vector<bool> drawn;
};

/// Returns the molecules outside of the polymers. Sugars are inside if they are bound to a polymer, directly or by
/// other sugars. atoms: as the readers return them, with residues in the order of the file. bonds: the bonds of the
/// file, by Atom::index; bonds by distance are added as in molecule_bonds(). Time is linear in the number of atoms.
OutsidePolymer outside_polymer(std::span<const Atom> atoms, std::span<const Bond> bonds);

/// True if there is nothing but ions and water, so that the ions are what the file is about, such as a slab of metal.
bool has_only_ions(std::span<const Atom> atoms);

}  // namespace meniscus
