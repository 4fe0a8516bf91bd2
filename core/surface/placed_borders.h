// SPDX-License-Identifier: BSD-3-Clause
// The positions of the vertices and borders of a surface, before its faces are known.
#pragma once

#include <cstdint>
#include <vector>

#include "core/surface/cusps.h"
#include "core/surface/fixed_probes.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Where the borders of one toroidal patch start, and what they are: contact circles first, then the ends.
struct PatchBorders {
  std::uint32_t first = 0;
  bool free = false;
  bool spindle = false;
  std::uint32_t contact(int side) const { return first + side; }
  std::uint32_t edge(int end) const { return first + 2 + end; }                            // not a spindle
  std::uint32_t half_edge(int end, int side) const { return first + 2 + 2 * end + side; }  // spindle
};

/// What is where in the tables of vertices and borders.
struct PlacedBorders {
  std::vector<PatchBorders> of_patch;      ///< per toroidal patch
  std::vector<std::uint32_t> axis_vertex;  ///< the same: the first of the two on its axis if it is a spindle
  std::uint32_t first_cusp = 0;            ///< the border of the first of CuspParts::arcs
};

/// Fills in surface.vertices and surface.borders but for the borders' faces. `surface` holds atoms, toroidal and
/// concave patches; `probes` and `cusps` are what they were made of.
PlacedBorders place_borders(Surface& surface, const FixedProbes& probes, const CuspParts& cusps);

}  // namespace meniscus
