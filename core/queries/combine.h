// SPDX-License-Identifier: BSD-3-Clause
// Several surfaces, and copies of them, as one: for pictures and formats that know a single surface only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/surface/primitives.h"
#include "core/math/rigid_motion.h"

namespace meniscus {

struct SurfaceObject;

/// Adds a copy of `part`, moved, to `whole`: its tables follow those of `whole`, areas and volumes add up. Surfaces
/// stay closed and their own; where they overlap nothing is cut away. Both need the same probe radius, unless `whole`
/// is still empty. Throws CapacityError when a table gets more rows than an index can count.
void append(Surface& whole, const Surface& part, const RigidMotion& motion = {});

/// One object with every copy of every given one, in order, standing where they stand. A single object with a single
/// copy that is not moved passes through as it is. Colours, opacities and atoms follow, the hidden stay hidden;
/// either all objects are coloured by patch kind, alike, or none is. No objects: an empty one. Throws CapacityError.
SurfaceObject merged(std::vector<SurfaceObject> objects);

/// SurfaceObject::atom of an atom of merged(objects), without merging them.
std::uint32_t merged_atom(std::span<const SurfaceObject> objects, std::size_t atom);

/// The balls of every copy of every object, in the order of merged().surface.atoms.
std::vector<Ball> placed_balls(std::span<const SurfaceObject> objects);

}  // namespace meniscus
