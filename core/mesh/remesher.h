// SPDX-License-Identifier: BSD-3-Clause
// Passes over a mesh on a surface that bring edges to the wanted lengths and make triangles even.
#pragma once

#include <cstdint>
#include <span>

#include "core/mesh/mesh_on_surface.h"

namespace meniscus {

/// Remeshes by splits, collapses, flips and moves of vertices (Botsch & Kobbelt, "A remeshing approach to
/// multiresolution modeling", 2004, section 4). Around guarded vertices (CrossingGuard) no pass lets triangles pass
/// through others.
class Remesher {
 public:
  /// `mesh` must outlive the remesher.
  explicit Remesher(MeshOnSurface& mesh) : mesh_(mesh) {}

  /// Refines triangles coarser than wanted: splits and collapses edges until few are too long or too short.
  void approach();
  /// Splits long edges, collapses short ones, flips edges and relaxes vertices, `rounds` times.
  void even_out(int rounds);
  /// Shortens the wanted edges around these triangles by `factor`, and confines later passes to their neighbourhood.
  void refine(std::span<const std::uint32_t> triangles, double factor);

 private:
  /// True if passes may change the edge.
  bool is_changeable(std::uint32_t half) const;
  /// Splits the edges longer than `limit` times the wanted length; returns how many.
  std::uint32_t split_long(double limit);
  bool split(std::uint32_t half);
  /// Collapses the edges that are too short; returns how many.
  std::uint32_t collapse_short();
  bool try_collapse(std::uint32_t half);
  void flip_edges();
  bool try_flip(std::uint32_t half);
  void relax();

  MeshOnSurface& mesh_;
  bool approaching_ = false;
};

}  // namespace meniscus
