// SPDX-License-Identifier: BSD-3-Clause
// Beads of the coarse-grained force field Martini, versions 2 and 3: their types, radii, classes and bonds by names.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/structure/structure.h"

namespace meniscus {

/// What a bead stands for, by the letter of its type. `backbone`: of Martini 2 proteins, where it depends on the
/// secondary structure, which names do not tell.
enum class BeadClass : std::uint8_t { charged, polar, intermediate, apolar, water, backbone };

struct Bead {
  std::string_view
      type;       ///< "SP2", "Q5n", "TC3"; what it differs by in other letters than size and class may be left out
  double radius;  ///< Å: half the distance of the energy minimum of two such beads, sigma * 2^(1/6) / 2
  BeadClass kind;
};

/// The version of the beads among the atoms: 3 or 2; 0: there are none. Beads are atoms without an element in a
/// residue that has a bead's name which no atom has (BB, PO4, GL1, ...), and what classify_atoms found beside these.
struct MartiniVersion {
  int number = 0;
  bool certain = true;  ///< false: no residue tells 2 from 3, and it is 3
};
MartiniVersion martini_version(std::span<const Atom> atoms);

/// Is this the name of a bead, and of no atom in the wwPDB's components: BB, PO4, GL1, ...?
bool is_martini_mark(std::string_view name);
/// Does this residue consist of beads? names: of its atoms.
bool has_martini_names(const std::string& residue_name, std::span<const std::string> names);
/// W, WF, PW, SW or TW, which stand for several molecules of water.
bool is_martini_water(const std::string& residue_name);
/// A single bead for an ion and its shell of water: in residues ION, NA+, CL, ...
bool is_martini_ion(const std::string& residue_name);

/// Nothing: no bead that is known. version: 2 or 3. Types are those of S. J. Marrink et al., J. Phys. Chem. B 111, 7812
/// (2007), D. H. de Jong et al., J. Chem. Theory Comput. 9, 687 (2013) and P. C. T. Souza et al., Nat. Methods 18, 382
/// (2021); sigma is 4.7 Å, of small beads 4.3 (version 2) or 4.1 (version 3), of tiny ones 3.4 Å.
std::optional<Bead> martini_bead(const std::string& residue_name, const std::string& name, int version);

/// Bonds between beads of these atoms, by their names, as places in `atoms`: side chains, heads and tails of lipids,
/// sterols from bead to bead; and BB of residues that follow each other, at most 5 Å apart. At most 8 Å long.
std::vector<Bond> martini_bonds(std::span<const Atom> atoms);

}  // namespace meniscus
