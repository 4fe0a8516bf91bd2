// SPDX-License-Identifier: BSD-3-Clause
// Planes that separate the faces of one spherical patch.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace meniscus {

struct Plane;
struct Surface;

/// Some faces of one patch, and the planes inside of which they lie and the patch's other faces do not.
struct PartedFaces {
  std::vector<std::uint32_t> faces;
  std::vector<Plane> planes;
};

/// Parts the faces `kept` of a spherical patch from the faces `dropped` of the same patch: all kept ones together if
/// planes can do it, else each by itself. Throws CapacityError when no plane lies between two faces.
std::vector<PartedFaces> part_faces(const Surface& surface, std::span<const std::uint32_t> kept,
                                    std::span<const std::uint32_t> dropped);

/// A plane with all borders of the faces `inside` strictly inside and all those of `outside` strictly outside, as far
/// from both as can be; nothing if their convex hulls meet. Faces of one sphere that have no point in common lie on
/// the same sides as their borders do.
std::optional<Plane> plane_between(const Surface& surface, std::span<const std::uint32_t> inside,
                                   std::span<const std::uint32_t> outside);

}  // namespace meniscus
