// SPDX-License-Identifier: BSD-3-Clause
// Computes surfaces too large for memory block by block: their numbers and, on request, their patches.
//
// The faces that touch an atom depend only on atoms within 2 R + 4 p of it (R: the largest radius, p: the probe's
// radius). A fixed probe that touches the atom is within R + p of it, a probe that cuts this one is within 2 p more,
// and the atoms that the second probe touches, or that block it, are within R + p more. So the surface of a block and
// its halo, which are all atoms within that reach, has the block's faces as the whole surface has them, to the last
// bit. Each face belongs to the block of the lowest atom that it touches. Borders between faces of two blocks are
// seams. Both blocks find them, and the two must match bit by bit, or the surface is not closed there. Seams join
// pieces to components.
#pragma once

#include "core/surface/components.h"
#include "core/surface/compute_surface.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Returns blocks of at most `most` atoms, made by repeated halving along the widest axis. Each block is a list of
/// ascending indices.
std::vector<std::vector<std::uint32_t>> divide_into_blocks(std::span<const Ball> atoms, std::size_t most);

/// Returns the width of the halo around a block's atoms, Å: 2 R + 4 p, and slightly more for rounding.
double halo_reach(std::span<const Ball> atoms, double probe_radius);

/// Returns ascending indices of a block's own atoms and its halo, which are all atoms within `reach` of the box around
/// the block's atoms.
std::vector<std::uint32_t> with_halo(std::span<const Ball> atoms, std::span<const std::uint32_t> block, double reach);

/// Returns the surface without tables: their sums (Surface::sums), the components and the certificate, which is as
/// strict as for the whole surface. With ClipPlanes::listed it has its patches, from `convex` to `contacts`, too,
/// except patches that have no area with a probe of radius 0. Callers must check the certificate. All numbers and
/// patches equal the whole surface's to the last bit unless ties had to be broken: radii then grow as in
/// compute_through_ties(), but only for atoms around the open ones, and only the blocks with such atoms are computed
/// again. It is computed on the CPU. atoms: van der Waals balls in Å; probe_radius >= 0 in Å; blocks: each atom is in
/// one; reach: at least halo_reach(); attempts: one more than the number of times that radii at one place may grow.
/// Throws CapacityError.
Surface surface_in_blocks(std::span<const Ball> atoms, double probe_radius,
                          std::span<const std::vector<std::uint32_t>> blocks, double reach, ClipPlanes planes,
                          StageClock& clock, int attempts = kTieAttempts);

/// Computes the surface by blocks if there are enough atoms for it to be worthwhile, otherwise by compute_surface() on
/// the CPU.
Surface compute_without_borders(std::span<const Ball> atoms, double probe_radius, ClipPlanes planes, StageClock& clock);

struct BlockPatches;

/// The contribution of a face to its component. Each block numbers its own pieces.
struct FaceSum {
  std::uint32_t atom = 0;  ///< the lowest atom that the face touches
  std::uint32_t piece = 0;
  double area = 0.0;
  double flux = 0.0;
};

/// A border between a face of this block and one of another, seen from this one.
struct SeamBorder {
  std::uint64_t key = 0;
  std::uint32_t piece = 0;
  std::uint32_t atom_and_side = 0;
  auto operator<=>(const SeamBorder&) const = default;
};

/// An end of a SeamBorder.
struct SeamVertex {
  std::uint64_t key = 0;
  std::uint32_t piece = 0;
  auto operator<=>(const SeamVertex&) const = default;
};

/// The part of a block's surface that is kept.
struct BlockPart {
  std::array<std::vector<FaceSum>, 3> faces;  ///< one list for each kind, by ascending atoms
  std::vector<Farthest> farthest;             ///< one for each piece
  std::vector<int> euler;                     ///< one for each piece, without the vertices at seams
  std::vector<SeamBorder> borders;
  std::vector<SeamVertex> vertices;
  SurfaceCounts counts;
  std::vector<double> atom_surface, atom_accessible;  ///< areas of its own atoms
  std::vector<std::uint32_t> open_atoms;
  double exact_within = 0.0;
};

/// Returns the place of a kind's faces in BlockPart::faces.
inline std::size_t place_of(PatchKind kind) { return static_cast<std::size_t>(kind); }

/// Computes the surface of a block's atoms and its halo, and keeps the faces that belong to the block because their
/// lowest atom does. numbers: ascending indices in the whole surface; atoms: the atoms with these numbers; is_own: 1
/// for each atom of the block itself; origin: the origin of integrals (measure.h); patches: receives the block's
/// patches unless it is nullptr.
BlockPart compute_block(std::vector<Ball> atoms, std::span<const std::uint32_t> numbers, std::vector<char> is_own,
                        double probe_radius, const glm::dvec3& origin, BlockPatches* patches, StageClock& clock);

/// An end of a toroidal patch at a fixed probe of another block, which has the same centre there, to the last bit.
struct OutsideEnd {
  std::uint32_t patch = 0;  ///< into BlockPatches::toroidal
  int end = 0;
  glm::dvec3 probe{0.0};  ///< Å
};

/// The block's own patches, whose lowest atom belongs to the block. Atoms have their numbers in the whole surface;
/// `planes`, `contacts` and ToroidalPatch::probe are those in the block.
struct BlockPatches {
  std::vector<ConvexPatch> convex;
  std::vector<ToroidalPatch> toroidal;
  std::vector<ConcavePatch> concave;  ///< by ascending first contacts
  std::vector<Plane> planes;
  std::vector<std::uint32_t> contacts;
  std::vector<OutsideEnd> outside;
};

/// Takes the block's own patches from the surface of the block and its halo, which must have clip planes. number:
/// numbers of the surface's atoms in the whole; is_own: 1 for each atom of the block itself.
BlockPatches take_patches(const Surface& surface, std::span<const std::uint32_t> number, std::span<const char> is_own);

/// Moves the patches of all blocks to the whole surface, in the order in which it would have them. Returns the atoms at
/// which a toroidal patch ends at no probe of any block: none, if the seams of all blocks match. block_of: the block of
/// each atom. Throws CapacityError.
std::vector<std::uint32_t> join_patches(std::span<const std::uint32_t> block_of, std::span<BlockPatches> blocks,
                                        Surface& whole);

/// Calls visit(block, place) for the rows of all blocks in the order of their atoms. block_of: the block of each atom;
/// rows: the member of a block that has its rows, in ascending order of atom_of(block, row).
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

/// Joins pieces to components where blocks meet, adds up faces in the order in which the whole surface has them, and
/// makes the checks of components (certificate.h). Seams that do not match make the surface open at their atoms.
/// blocks: the own atoms of each part; block_of: the block of each atom. The surface has no tables and no atoms.
Surface sum_blocks(std::span<const Ball> atoms, double probe_radius, std::span<const std::vector<std::uint32_t>> blocks,
                   std::span<const std::uint32_t> block_of, std::span<const BlockPart> parts);

}  // namespace meniscus
