// SPDX-License-Identifier: BSD-3-Clause
// What is kept of one block of a surface (blocks.h) when its tables are let go.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/surface/components.h"
#include "core/surface/primitives.h"

namespace meniscus {

class StageClock;
struct BlockPatches;

/// What a face contributes to its component. Each block numbers its own pieces.
struct FaceSum {
  std::uint32_t atom = 0;  ///< the lowest that it touches
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

/// An end of such a border.
struct SeamVertex {
  std::uint64_t key = 0;
  std::uint32_t piece = 0;
  auto operator<=>(const SeamVertex&) const = default;
};

/// What is kept of a block.
struct BlockPart {
  std::array<std::vector<FaceSum>, 3> faces;  ///< by kind, of rising atoms
  std::vector<Farthest> farthest;             ///< by piece
  std::vector<int> euler;                     ///< by piece, without the vertices at seams
  std::vector<SeamBorder> borders;
  std::vector<SeamVertex> vertices;
  SurfaceCounts counts;
  std::vector<double> atom_surface, atom_accessible;  ///< of its own atoms
  std::vector<std::uint32_t> open_atoms;
  double exact_within = 0.0;
};

/// The place of a kind's faces in BlockPart::faces.
inline std::size_t place_of(PatchKind kind) { return static_cast<std::size_t>(kind); }

/// Computes the surface of a block's atoms and its halo; keeps of it what is the block's own: faces whose lowest atom
/// is. atoms: those of the whole with these numbers, rising; is_own: of each; origin: of integrals (measure.h);
/// patches: get those of the block, unless it is nullptr.
BlockPart compute_block(std::vector<Ball> atoms, std::span<const std::uint32_t> numbers, std::vector<char> is_own,
                        double probe_radius, const glm::dvec3& origin, BlockPatches* patches, StageClock& clock);

}  // namespace meniscus
