// SPDX-License-Identifier: BSD-3-Clause
// Tells lipids and sterols from other residues by their names.
#pragma once

#include <span>
#include <string>

namespace meniscus {

struct Atom;

/// Is this residue a lipid, a fatty acid or a sterol? By names of the wwPDB's chemical components and those that
/// CHARMM, AMBER Lipid21 (heads and tails are residues there), GROMOS and Martini give: two letters for the tails and
/// two for the head, as POPC, besides single names. No polymer, water or ion is one, and no detergent.
bool is_lipid(std::span<const Atom> residue);

}  // namespace meniscus
