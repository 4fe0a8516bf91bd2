// SPDX-License-Identifier: BSD-3-Clause
// From the half-borders of one spherical patch to its loops, and from loops to connected faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/surface/primitives.h"

namespace meniscus {

/// The loops and faces of one convex or concave patch before they get their global numbers.
struct PatchFaces {
  std::vector<HalfBorder> half_borders;   ///< loop after loop
  std::vector<std::uint32_t> loop_sizes;  ///< half-borders of each loop
  std::vector<std::uint32_t> loop_face;   ///< per loop: its face, counted within the patch
  std::uint32_t face_count = 0;
  bool closed = true;  ///< false if some walk does not return to where it began
};

/// Chains `walk`, the half-borders that have the patch on their left, end to begin, and finds out which loops bound the
/// same connected piece of the sphere. No half-borders: a whole sphere is one face; a concave patch then has none left.
PatchFaces chain_faces(std::span<const Border> borders, std::span<const HalfBorder> walk, const glm::dvec3& center,
                       double radius, bool seen_from_inside);

}  // namespace meniscus
