// SPDX-License-Identifier: BSD-3-Clause
// Atoms that belong together: chains, models, classes, residues.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace meniscus {

struct Atom;
struct Structure;

enum class Grouping : std::uint8_t {
  chain,       ///< same model and chain
  model,       ///< same model
  atom_class,  ///< same AtomClass
  residue      ///< same residue
};

/// Some atoms and what to call them.
struct AtomGroup {
  std::string name;                  ///< text of the file may be in it: never into the source code of another program
  std::vector<std::uint32_t> atoms;  ///< indices into Structure::atoms, ascending
};

/// Every atom in exactly one group, in order of first appearance. Names: "chain A" ("chain A of model 2" when there are
/// several models; "unnamed chain" when the file gives none), "model 2", "ligand", "chain A 35B LEU".
std::vector<AtomGroup> group_atoms(const Structure& structure, Grouping by);

/// Where an atom stands in its file: "chain A 35B LEU CD1", or "atom 12" (from 1) where the format has no names.
std::string atom_place(const Atom& atom);

}  // namespace meniscus
