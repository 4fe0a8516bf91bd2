// SPDX-License-Identifier: BSD-3-Clause
// The positions of the vertices and borders of a surface, before its faces are known.
#pragma once

#include <cstdint>
#include <vector>

#include "core/surface/cusps.h"
#include "core/surface/fixed_probes.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// The index of the first border of one toroidal patch, and the order of its borders: contact circles, then the ends.
struct PatchBorders {
  std::uint32_t first = 0;
  bool free = false;
  bool spindle = false;
  std::uint32_t contact(int side) const { return first + side; }
  std::uint32_t edge(int end) const { return first + 2 + end; }  // for patches that are not spindles
  std::uint32_t half_edge(int end, int side) const { return first + 2 + 2 * end + side; }  // for spindles
};

/// The places of vertices and borders in their tables.
struct PlacedBorders {
  std::vector<PatchBorders> of_patch;  ///< per toroidal patch
  std::vector<std::uint32_t>
      axis_vertex;               ///< per toroidal patch: the first of the two vertices on its axis, if it is a spindle
  std::uint32_t first_cusp = 0;  ///< the border of the first of CuspParts::arcs
};

/// Computes surface.vertices and surface.borders without the borders' faces. `surface` holds atoms, toroidal and
/// concave patches; `probes` and `cusps` are the tables that they were made from.
PlacedBorders place_borders(Surface& surface, const FixedProbes& probes, const CuspParts& cusps);

}  // namespace meniscus
