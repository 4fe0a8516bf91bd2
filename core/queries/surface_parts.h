// SPDX-License-Identifier: BSD-3-Clause
// Extracts closed parts of a surface as a surface of their own, such as the surface without its cavities.
#pragma once

#include <cstdint>
#include <vector>

#include "core/surface/primitives.h"

namespace meniscus {

/// A part of a surface with only the atoms that it touches.
struct SurfacePart {
  Surface surface;
  std::vector<std::uint32_t> atom;  ///< per surface.atoms: its index in the whole surface
};

/// Returns the components c with keep[c] as a closed surface with tables of its own. Its faces, borders and measures
/// are those of the whole surface; patches without a remaining face are dropped. A patch may have faces that stay and
/// faces that go, for example on an atom between the outside and a cavity. Planes are then added that separate them,
/// and if no plane separates some of the faces that stay from others, each gets a patch of its own. Throws
/// CapacityError if a face cannot be separated from another one of its patch by a plane.
SurfacePart part_of(const Surface& surface, const std::vector<bool>& keep);

/// Returns true for the components that the outside reaches: all but cavities and what lies inside of a cavity. An
/// island such as an atom that floats in a cage is not reached, although by itself it is an outer component.
std::vector<bool> reached_from_outside(const Surface& surface);

/// Returns how often a component winds around a point that is not on it, seen from its solvent's side: 1 around a point
/// in the solid that it encloses, -1 around a point in a cavity that it encloses, 0 otherwise. The point (Å) is in no
/// ball that the component touches unless the component encloses that ball, and in no probe that touches it.
int winding_number(const Surface& surface, std::uint32_t component, const glm::dvec3& point);

}  // namespace meniscus
