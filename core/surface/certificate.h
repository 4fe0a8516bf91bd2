// SPDX-License-Identifier: BSD-3-Clause
// What a finished surface must satisfy, in its combinatorics and in its numbers, whichever device computed it.
#pragma once

#include "core/surface/measure.h"
#include "core/surface/primitives.h"

namespace meniscus {

class ConvexPlanes;

/// Completes the certificate of a measured surface: adds the atoms of whatever fails to Certificate::open_atoms and
/// sets Certificate::closed if there are none. Checked are
///  * the Euler characteristic of every component: even and at most 2 (theorem 3);
///  * the area of every face: from 0 to that of its whole sphere or torus, of a concave one to half of it, for a probe
///    has all atoms that it touches on one side; all faces of an atom together fill one sphere at most;
///  * an atom that shows next to nothing or next to everything: its clip planes leave as much;
///  * every face whose corners are blurred: both closed forms give one area (MeasurementDoubts);
///  * every fixed probe: its contacts go round it the right way, without a corner inwards;
///  * every component: volume positive for outer ones; a cavity (side_of_components()) has room for the probe;
///  * every re-entrant patch with such a face, with more than three contacts, cut from close by, or cut without a cusp:
///  its
///    planes and its borders give one area (divided_area()).
void certify(Surface& surface, const MeasurementDoubts& doubts, const ConvexPlanes& planes);

/// Of these the first and the last but one: those of a component as a whole.
bool is_sound(const Component& component, double probe_radius);

/// All others: the atoms at which they fail, in rising order.
std::vector<std::uint32_t> unsound_atoms(const Surface& surface, const MeasurementDoubts& doubts,
                                         const ConvexPlanes& planes);

void certify(Surface& surface, const MeasurementDoubts& doubts);  ///< by the planes that its tables list

}  // namespace meniscus
