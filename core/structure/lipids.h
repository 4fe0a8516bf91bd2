// SPDX-License-Identifier: BSD-3-Clause
// Recognizes lipids and sterols by the names of their residues.
#pragma once

#include <span>
#include <string>

namespace meniscus {

struct Atom;

/// True if the residue is a lipid, a fatty acid or a sterol. Names are those of the wwPDB's chemical components and of
/// CHARMM, AMBER Lipid21 (where heads and tails are residues), GROMOS and Martini. Most of these have two letters for
/// the tails and two for the head, as in POPC. Polymers, water, ions and detergents are not lipids.
bool is_lipid(std::span<const Atom> residue);

}  // namespace meniscus
