// SPDX-License-Identifier: BSD-3-Clause
// The numbers of a whole surface from those of its blocks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/surface/block_part.h"

namespace meniscus {

/// Joins pieces to components where blocks meet, adds up faces in the order in which the whole surface has them, and
/// makes the checks of components (certificate.h). Seams that do not match make the surface open at their atoms.
/// blocks: the own atoms of each part; block_of: the block of each atom. The surface has no tables and no atoms.
Surface sum_blocks(std::span<const Ball> atoms, double probe_radius, std::span<const std::vector<std::uint32_t>> blocks,
                   std::span<const std::uint32_t> block_of, std::span<const BlockPart> parts);

}  // namespace meniscus
