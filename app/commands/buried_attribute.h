// SPDX-License-Identifier: BSD-3-Clause
// The attribute buried_area of exported meshes: the area of each atom that other chains bury.
#pragma once

#include <string>
#include <vector>

#include "core/scene/molecule.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Å² of each atom of the structure; empty where `names` does not have "buried_area". Of a molecule with copies, for
/// which it cannot be said, the name goes from a list of all names, and is refused by RequestError in any other.
std::vector<double> buried_by_chains(const MoleculeRequest& molecule, const Structure& structure,
                                     std::vector<std::string>& names, bool all);

}  // namespace meniscus
