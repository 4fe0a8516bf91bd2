// SPDX-License-Identifier: BSD-3-Clause
// A surface whose tables are too large for memory, computed block by block of its atoms: its numbers and, if need be,
// its patches.
//
// The faces that an atom takes part in depend on atoms within 2 R + 4 p of it alone (R: the largest radius, p: the
// probe's): a fixed probe that touches it is within R + p, a probe that cuts that one within 2 p more, and what that
// one touches or is blocked by within R + p more. So the surface of a block's atoms and of all within that reach, its
// halo, has the block's faces as the whole surface has them, to the last bit. Each face belongs to the block of the
// lowest atom that it touches. Borders between faces of two blocks, the seams, are found by both: each must match one
// of another block, bit by bit, or the surface is not closed there. Seams join pieces to components.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/surface/compute_surface.h"
#include "core/surface/primitives.h"

namespace meniscus {

class StageClock;

/// Atoms by block, each a list of rising indices, of at most `most` atoms: halves of halves along the widest axis.
std::vector<std::vector<std::uint32_t>> divide_into_blocks(std::span<const Ball> atoms, std::size_t most);

/// How far the halo of a block reaches beyond its atoms, Å: as above, and a little more for rounding.
double halo_reach(std::span<const Ball> atoms, double probe_radius);

/// A block's own atoms and its halo, all within `reach` of the box around them: rising indices.
std::vector<std::uint32_t> with_halo(std::span<const Ball> atoms, std::span<const std::uint32_t> block, double reach);

/// The surface without tables: what they add up to (Surface::sums), the components and the certificate, which is as
/// strict as that of the whole surface. With ClipPlanes::listed it has its patches, from `convex` to `contacts`, too;
/// those that no probe of size leaves area are left out. Look at the certificate. All numbers and patches are those of
/// the whole surface, to the last bit, unless ties had to be told apart: radii then grow as in compute_through_ties(),
/// but of atoms around the open ones alone, and only the blocks that have those are computed again. On the CPU. atoms:
/// van der Waals balls in Å; probe_radius >= 0 in Å; blocks: each atom is in one; reach: halo_reach() at least;
/// attempts: how often radii at one place grow, and 1. Throws CapacityError.
Surface surface_in_blocks(std::span<const Ball> atoms, double probe_radius,
                          std::span<const std::vector<std::uint32_t>> blocks, double reach, ClipPlanes planes,
                          StageClock& clock, int attempts = kTieAttempts);

/// By blocks, if the atoms are so many that these are worth while; else compute_surface() on the CPU.
Surface compute_without_borders(std::span<const Ball> atoms, double probe_radius, ClipPlanes planes, StageClock& clock);

}  // namespace meniscus
