// SPDX-License-Identifier: BSD-3-Clause
// Removes edges that are too short and triangles that are too flat for a file's numbers, and keeps the mesh closed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

struct TriangleMesh;

/// The result of welding vertices and triangles.
struct Welding {
  /// Per vertex: itself, or the vertex that it was merged into; kNone: it was removed.
  std::vector<std::uint32_t> into;
  std::vector<bool> removed;  ///< per triangle: true if it was removed
  std::size_t joined = 0;     ///< number of edges with ends that were merged
  std::size_t fins = 0;       ///< number of tips of fins that were removed first
  std::size_t flipped = 0;    ///< number of edges that were flipped
  std::size_t flat = 0;       ///< number of triangles that remain without area
};

/// Merges the ends of edges that are shorter than `step` (Å), or whose ends are the same point in multiples of it, at
/// the end with the lower number; the two triangles of such an edge vanish. An edge remains where merging its ends
/// would leave the mesh open or change its genus: where they have a common neighbour other than the two corners
/// opposite to the edge.
Welding weld_short_edges(std::span<const glm::dvec3> positions, std::vector<std::array<std::uint32_t, 3>>& triangles,
                         double step);

/// Welds a mesh for a file that holds `scale` times its positions in single precision.
///
/// Short edges are merged as by weld_short_edges(). An edge whose ends have a third common neighbour only because of a
/// fin is merged, too. A fin is two triangles back to back, no farther apart than the edge is long, with a tip that is
/// within the mesh's tolerance of what remains; there may be several such, one behind the other.
///
/// Then each triangle without area, its corners taken in multiples of `step` or in single precision, has its longest
/// edge flipped. If the new edge is too short, its ends are merged. Both triangles take the attributes of the one that
/// had an area. A closed mesh stays closed, with the same genus, and no vertex moves. Returns what was done;
/// Welding::into has the new number of each vertex.
Welding weld(TriangleMesh& mesh, double step, double scale);

}  // namespace meniscus
