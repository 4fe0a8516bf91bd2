// SPDX-License-Identifier: BSD-3-Clause
// Small molecules that together have every kind of patch.
#pragma once

#include <ostream>
#include <vector>

#include "core/color/coloring.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {

NamedBalls one_atom();
NamedBalls free_torus();    ///< two atoms, a whole saddle ring
NamedBalls free_spindle();  ///< two atoms so far apart that the ring crosses its axis
NamedBalls three_atoms();   ///< two fixed probes that do not touch
NamedBalls wide_arc();      ///< an arc of more than 180°
NamedBalls cut_probes();    ///< a spindle arc, and two fixed probes that cut each other
NamedBalls square();        ///< four atoms on one probe
/// Returns all of them for the probe kWater, a random gas and C60 (faces of five and six atoms, a cavity).
std::vector<NamedBalls> patch_molecules();

/// Gives atoms one to three colours in turn: with three, most neighbours differ, and some patches have one twice.
Coloring turning_colors(std::size_t atom_count, int color_count);

/// Prints a molecule's name in GoogleTest's messages.
inline void PrintTo(const NamedBalls& m, std::ostream* out) { *out << m.name; }

}  // namespace meniscus::testing
