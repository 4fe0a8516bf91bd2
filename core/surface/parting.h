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

/// Some faces of one patch, and planes that have these faces inside and the patch's other faces outside.
struct PartedFaces {
  std::vector<std::uint32_t> faces;
  std::vector<Plane> planes;
};

/// Separates the faces `kept` of a spherical patch from its faces `dropped`: all kept faces together if planes can do
/// it, else each by itself. Throws CapacityError when no plane separates two faces.
std::vector<PartedFaces> part_faces(const Surface& surface, std::span<const std::uint32_t> kept,
                                    std::span<const std::uint32_t> dropped);

/// Returns the plane with the largest margin that has all borders of the faces `inside` strictly inside and all borders
/// of `outside` strictly outside; nothing if their convex hulls meet. Faces of one sphere without a common point lie on
/// the same sides as their borders.
std::optional<Plane> plane_between(const Surface& surface, std::span<const std::uint32_t> inside,
                                   std::span<const std::uint32_t> outside);

}  // namespace meniscus
