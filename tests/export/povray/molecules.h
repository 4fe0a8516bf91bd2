// SPDX-License-Identifier: BSD-3-Clause
// Small molecules that between them have every kind of patch, and real ones from Debian packages.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "core/surface/coloring.h"
#include "core/surface/primitives.h"

namespace meniscus::testing {

inline constexpr double kWaterProbe = 1.4;

struct Molecule {
  std::string name;
  std::vector<Ball> balls;
};
/// For GoogleTest's messages.
inline void PrintTo(const Molecule& m, std::ostream* out) { *out << m.name; }

Molecule one_atom();
Molecule free_torus();                         ///< two atoms, a whole saddle ring
Molecule free_spindle();                       ///< two atoms so far apart that the ring crosses its axis
Molecule three_atoms();                        ///< two fixed probes that do not touch
Molecule wide_arc();                           ///< an arc of more than 180°
Molecule cut_probes();                         ///< a spindle arc, and two fixed probes that cut each other
Molecule square();                             ///< four atoms on one probe
Molecule blob(int atom_count, unsigned seed);  ///< atoms at random in a ball, with every degree of overlap
Molecule fullerene();                          ///< C60, ideal: faces of five and six atoms, a cavity
std::vector<Molecule> small_molecules();

/// Heavy atoms of the ATOM records of a PDB file, Bondi radii; empty when the file is missing.
Molecule pdb_molecule(const std::string& name, const std::string& path);
Molecule ubiquitin();    ///< 1UBQ of the package freesasa
Molecule enterotoxin();  ///< 1TII of the package pymol-data

/// One to three colours in turn: with three, neighbours mostly differ, and some patches have two atoms of one colour.
Coloring turning_colors(std::size_t atom_count, int color_count);

}  // namespace meniscus::testing
