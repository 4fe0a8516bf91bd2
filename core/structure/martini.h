// SPDX-License-Identifier: BSD-3-Clause
// Beads of the coarse-grained force field Martini, versions 2 and 3: their types, radii, classes and bonds, by names.
#pragma once

#include <string_view>

#include "core/structure/structure.h"

namespace meniscus {

/// The class of a bead by the letter of its type. `backbone` is a bead of Martini 2 proteins, whose class depends on
/// the secondary structure, which names do not tell.
enum class BeadClass : std::uint8_t { charged, polar, intermediate, apolar, water, backbone };

/// A type of beads.
struct Bead {
  /// The type, such as "SP2", "Q5n" or "TC3". Letters other than size and class may be left out.
  std::string_view type;
  double radius;  ///< Å: half the distance at the energy minimum of two such beads, sigma * 2^(1/6) / 2
  BeadClass kind;
};

/// The version of the beads among the atoms: 2 or 3, or 0 if there are none. A bead is an atom without element in a
/// residue with a name that only beads have (BB, PO4, GL1, ...), or in another residue of beads that classify_atoms
/// found.
struct MartiniVersion {
  int number = 0;
  bool is_certain = true;  ///< false: no residue distinguishes 2 and 3, and 3 is assumed
};
MartiniVersion martini_version(std::span<const Atom> atoms);

/// True if this is the name of a bead, such as BB, PO4 or GL1, but of no atom in the wwPDB's components.
bool is_martini_mark(std::string_view name);
/// True if this residue consists of beads. names: the names of its atoms.
bool has_martini_names(const std::string& residue_name, std::span<const std::string> names);
/// True for W, WF, PW, SW and TW, which stand for several water molecules.
bool is_martini_water(const std::string& residue_name);
/// True for a single bead that represents an ion and its water shell: in residues ION, NA+, CL, ...
bool is_martini_ion(const std::string& residue_name);

/// Returns the type of a bead, or nothing if it is not known. version: 2 or 3. Types are those of S. J. Marrink et al.,
/// J. Phys. Chem. B 111, 7812 (2007), D. H. de Jong et al., J. Chem. Theory Comput. 9, 687 (2013) and P. C. T. Souza et
/// al., Nat. Methods 18, 382 (2021). Sigma is 4.7 Å; for small beads it is 4.3 Å (version 2) or 4.1 Å (version 3), for
/// tiny beads 3.4 Å.
std::optional<Bead> martini_bead(const std::string& residue_name, const std::string& name, int version);

/// Returns the bonds between beads by their names, as places in `atoms`: in side chains, in heads and tails of lipids,
/// and along sterols. BB beads of consecutive residues are bonded if they are at most 5 Å apart. All bonds are at most
/// 8 Å long.
std::vector<Bond> martini_bonds(std::span<const Atom> atoms);

}  // namespace meniscus
