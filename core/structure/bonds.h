// SPDX-License-Identifier: BSD-3-Clause
// The bonds of a molecule: listed by its file, by the templates of standard residues, or guessed by distance.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/structure/periodic_cell.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Bonds of amino acids, nucleotides and water by the names of their heavy atoms; a hydrogen,
/// or a site without element, to the nearest heavy atom of its residue, within 1.6 Å; residues of a chain by C-N and
/// O3'-P within 2.2 Å; disulphides are left out, for chains hold together without them. positions: Å, one per atom;
/// cell: distances are to the nearest image.
std::vector<Bond> template_bonds(std::span<const Atom> atoms, std::span<const glm::dvec3> positions,
                                 const std::optional<PeriodicCell>& cell);

/// Bonds between atoms of one residue, and of residues next to each other in a chain, that are no farther apart than
/// their covalent radii (B. Cordero et al., Dalton Trans. 2008, 2832) and 0.4 Å.
std::vector<Bond> guessed_bonds(std::span<const Atom> atoms, std::span<const glm::dvec3> positions,
                                const std::optional<PeriodicCell>& cell);

/// The bonds between these atoms, as places in `atoms`, lower place first, each once and ascending: those of `listed`
/// (by Atom::index; in an assembly, those of each copy), template_bonds, and by distance wherever an atom is in no
/// standard residue: no farther apart than the covalent radii (B. Cordero et al., Dalton Trans. 2008, 2832) and 0.4 Å;
/// between standard residues, as in disulphides and cross-links, 0.2 Å. No distance binds two hydrogens, a free ion, an
/// atom of unknown element, or what is within 0.5 Å, which are duplicates. Never across models, copies, or
/// alternate locations: of two atoms with different letters, not if the residue of either has an atom in several of
/// them. Nothing longer than kLongestBond, which crosses a periodic box. O(n) for molecules. fully_bonded: models
/// (Atom::model) that have no others than those listed.
std::vector<Bond> molecule_bonds(std::span<const Atom> atoms, std::span<const Bond> listed,
                                 std::span<const std::int32_t> fully_bonded = {});

inline constexpr double kLongestBond = 4.0;  ///< Å; those of caesium to ligands are 3.3 Å long

}  // namespace meniscus
