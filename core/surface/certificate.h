// SPDX-License-Identifier: BSD-3-Clause
// The conditions that a finished surface must satisfy, in its combinatorics and in its numbers, on every device.
#pragma once

#include "core/surface/measure.h"
#include "core/surface/primitives.h"

namespace meniscus {

class ConvexPlanes;

/// Completes the certificate of a measured surface: adds the atoms of every violated condition to
/// Certificate::open_atoms, and sets Certificate::closed if there are none. The conditions are:
///  * The Euler characteristic of every component is even and at most 2 (theorem 3).
///  * The area of every face lies between 0 and that of its whole sphere or torus. The area of a concave face is at
///    most half of its sphere, because a probe has all atoms that it touches on one side. All faces of an atom together
///    fill at most one sphere.
///  * The clip planes of an atom that shows almost nothing or almost everything leave as much as its faces have.
///  * Both closed forms give one area for every face with blurred corners (MeasurementDoubts).
///  * The contacts of every fixed probe go around it in the right sense, without a reflex corner.
///  * The volume of every outer component is positive; every cavity (side_of_components()) has room for the probe.
///  * The planes and the borders of a re-entrant patch give one area (divided_area()). This is checked for patches with
///    a blurred face, with more than three contacts, with a nearby cut, or with a cut that has no cusp.
void certify(Surface& surface, const MeasurementDoubts& doubts, const ConvexPlanes& planes);

/// True if a component as a whole is sound: the first of these conditions, and the condition on volumes.
bool is_sound(const Component& component, double probe_radius);

/// Returns the atoms at which one of the other conditions is violated, in ascending order.
std::vector<std::uint32_t> unsound_atoms(const Surface& surface, const MeasurementDoubts& doubts,
                                         const ConvexPlanes& planes);

void certify(Surface& surface,
             const MeasurementDoubts& doubts);  ///< uses the clip planes listed in the surface's tables

}  // namespace meniscus
