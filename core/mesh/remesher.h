// SPDX-License-Identifier: BSD-3-Clause
// Passes that give a mesh on a surface the wanted edge lengths and even triangles.
#pragma once

#include <cstdint>
#include <span>

#include "core/mesh/mesh_on_surface.h"

namespace meniscus {

/// Splits, collapses, flips and moves of vertices (Botsch & Kobbelt, "A remeshing approach to multiresolution
/// modeling", 2004, section 4). Where the mesh is watched, no pass lets triangles pass through others.
class Remesher {
 public:
  /// mesh: has to live as long.
  explicit Remesher(MeshOnSurface& mesh) : mesh_(mesh) {}

  /// From triangles coarser than wanted: splits and collapses until few edges are too long or too short.
  void approach();
  /// Splits long edges, collapses short ones, flips and relaxes, `rounds` times.
  void even_out(int rounds);
  /// Asks for edges shorter by `factor` around these triangles, and confines what follows to their neighbourhood.
  void refine(std::span<const std::uint32_t> triangles, double factor);

 private:
  bool busy(std::uint32_t half) const;
  /// Edges longer than this times the length wanted; how many.
  std::uint32_t split_long(double limit);
  bool split(std::uint32_t half);
  std::uint32_t collapse_short();
  bool try_collapse(std::uint32_t half);
  void flip_edges();
  bool try_flip(std::uint32_t half);
  void relax();

  MeshOnSurface& mesh_;
  bool approaching_ = false;
};

}  // namespace meniscus
