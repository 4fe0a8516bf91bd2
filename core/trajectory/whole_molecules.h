// SPDX-License-Identifier: BSD-3-Clause
// Molecules that a periodic box has cut apart, made whole along their bonds and gathered again.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/structure/structure.h"

namespace meniscus {

class WholeMolecules {
 public:
  /// Molecules are what the bonds join; those with an atom in `wanted` are treated. Throws InputError(file) when a
  /// residue of theirs falls apart because bonds are missing.
  WholeMolecules(std::span<const Atom> atoms, std::span<const Bond> bonds, std::span<const std::uint32_t> wanted,
                 const std::string& file);

  /// Moves atoms by lattice vectors: each molecule is whole as it hangs together by its bonds, and its centre is as
  /// near as can be to the centre of the one with most atoms. cell: columns a, b, c, Å. Throws InputError(where) for a
  /// box without volume, and for a molecule that is bonded to its own image.
  void apply(const glm::dmat3& cell, std::vector<glm::dvec3>& positions, const std::string& where) const;

 private:
  /// An atom, and the one before it in its molecule that it is bonded to; itself for the first.
  struct Step {
    std::uint32_t atom, from;
  };

  std::vector<Step> steps_;          ///< molecule after molecule, each atom behind the one it hangs on
  std::vector<std::size_t> begins_;  ///< of the molecules in steps_, and its end; the largest comes first
  std::vector<Bond> bonds_;          ///< of these molecules
};

}  // namespace meniscus
