// SPDX-License-Identifier: BSD-3-Clause
// Removes edges too short and triangles too flat for the numbers of a file; the mesh stays closed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

struct TriangleMesh;

/// What became of vertices and triangles.
struct Welding {
  std::vector<std::uint32_t> into;  ///< per vertex: itself, or the one that it was joined with; kNone: it is gone
  std::vector<bool> gone;           ///< per triangle
  std::size_t joined = 0;           ///< edges whose ends are one vertex now
  std::size_t fins = 0;             ///< that went before, by their tips
  std::size_t flipped = 0;          ///< edges that went to the other diagonal
  std::size_t flat = 0;             ///< triangles that stayed without area
};

/// Joins the ends of edges shorter than `step` (Å), or whose ends are the same point in multiples of it, at the end
/// with the lower number; their two triangles vanish. An edge stays where joining its ends would leave the mesh open or
/// change its genus: where they have another common neighbour than the two corners across from the edge.
Welding weld_short_edges(std::span<const glm::dvec3> positions, std::vector<std::array<std::uint32_t, 3>>& triangles,
                         double step);

/// The same of what a file holds, `scale` times the positions in single precision; an edge whose ends have that third
/// neighbour because of a fin goes, too: two triangles back to back, no farther apart than the edge is long, with a tip
/// that is within the mesh's tolerance of what stays, or several such, one behind the other. Then triangles without
/// area, their corners taken in multiples of `step` or in single precision, lose their longest edge to the other
/// diagonal of the two triangles at it, and where that is too short its ends are joined. Both triangles take what they
/// belong to from the one that had an area. A closed mesh stays closed, with the genus it had, and no vertex moves.
/// Returns what was done; `into` has the new place of each vertex.
Welding weld(TriangleMesh& mesh, double step, double scale);

}  // namespace meniscus
