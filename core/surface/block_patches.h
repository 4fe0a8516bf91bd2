// SPDX-License-Identifier: BSD-3-Clause
// The patches of a block, which pictures need when its other tables are let go (blocks.h), and those of all blocks.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus {

/// An end of a toroidal patch at a fixed probe of another block, which has the same centre there, to the last bit.
struct OutsideEnd {
  std::uint32_t patch = 0;  ///< into BlockPatches::toroidal
  int end = 0;
  glm::dvec3 probe{0.0};  ///< Å
};

/// The block's own patches: those whose lowest atom is. Atoms have the numbers of the whole; `planes`, `contacts` and
/// ToroidalPatch::probe are of this block.
struct BlockPatches {
  std::vector<ConvexPatch> convex;
  std::vector<ToroidalPatch> toroidal;
  std::vector<ConcavePatch> concave;  ///< of rising first contacts
  std::vector<Plane> planes;
  std::vector<std::uint32_t> contacts;
  std::vector<OutsideEnd> outside;
};

/// surface: of a block and its halo, with clip planes; number: of its atoms in the whole; is_own: of each.
BlockPatches take_patches(const Surface& surface, std::span<const std::uint32_t> number, std::span<const char> is_own);

/// Gives the whole surface the patches of all blocks, in the order in which it would have them, and takes them from
/// there. Returns the atoms at which a toroidal patch ends at no probe of any block: none, if the seams of all blocks
/// match. block_of: the block of each atom. Throws CapacityError.
std::vector<std::uint32_t> join_patches(std::span<const std::uint32_t> block_of, std::span<BlockPatches> blocks,
                                        Surface& whole);

/// Calls visit(block, place) for the rows of all blocks in the order of their atoms. block_of: the block of each atom;
/// rows: the member of a block that has its rows, of rising atom_of(block, row).
template <typename Blocks, typename Rows, typename AtomOf, typename Visit>
void for_each_by_atom(std::span<const std::uint32_t> block_of, const Blocks& blocks, const Rows& rows,
                      const AtomOf& atom_of, const Visit& visit) {
  std::vector<std::uint32_t> next(blocks.size(), 0);
  for (std::uint32_t a = 0; a < block_of.size(); ++a) {
    const auto& block = blocks[block_of[a]];
    const auto& own = std::invoke(rows, block);
    for (std::uint32_t& n = next[block_of[a]]; n < own.size() && atom_of(block, own[n]) == a; ++n)
      visit(block_of[a], n);
  }
}

}  // namespace meniscus
