// SPDX-License-Identifier: BSD-3-Clause
// Some closed parts of a surface as a surface of their own, such as the surface without its cavities.
#pragma once

#include <cstdint>
#include <vector>

#include "core/surface/primitives.h"

namespace meniscus {

/// A part of a surface, with the atoms that it touches only.
struct SurfacePart {
  Surface surface;
  std::vector<std::uint32_t> atom;  ///< per surface.atoms: its index in the whole
};

/// The components c with keep[c], whole and closed, with tables of their own: faces, borders and numbers as they were,
/// patches without a face left behind. A patch may have faces that stay and faces that go, an atom between the outside
/// and a cavity: planes are added that part them, and if no plane parts some of those that stay from others, each
/// gets a patch of its own. Throws CapacityError when a face cannot be parted from another one of its patch by a plane.
SurfacePart part_of(const Surface& surface, const std::vector<bool>& keep);

/// True for the components that the outside reaches: all but cavities and what lies inside of a cavity, an island such
/// as an atom that floats in a cage, though by itself an island is an outer component.
std::vector<bool> reached_from_outside(const Surface& surface);

/// How often a component goes round a point that is not on it, seen from its solvent's side: 1 around a point in the
/// solid it encloses, -1 around a point in a cavity it encloses, 0 else. The point: Å, in no ball that the component
/// touches unless the component encloses that ball, and in no probe that touches it.
int winding_number(const Surface& surface, std::uint32_t component, const glm::dvec3& point);

}  // namespace meniscus
