// SPDX-License-Identifier: BSD-3-Clause
// The bonds of molecules whose file lists none: by the templates of standard residues, or guessed by distance.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/structure/structure.h"
#include "core/structure/periodic_cell.h"

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

}  // namespace meniscus
