// SPDX-License-Identifier: BSD-3-Clause
// From the half-borders of one spherical patch to its loops, and from loops to connected faces.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/surface/primitives.h"
#include "core/surface/spherical.h"

namespace meniscus {

/// The loops and faces of one convex or concave patch before they get their global numbers.
struct PatchFaces {
  std::vector<HalfBorder> half_borders;   ///< loop after loop
  std::vector<std::uint32_t> loop_sizes;  ///< half-borders of each loop
  std::vector<std::uint32_t> loop_face;   ///< per loop: its face, counted within the patch
  std::uint32_t face_count = 0;
  bool closed = true;  ///< false if some walk does not return to where it began
};

/// Finds loops and faces of one patch after another; keeps its lists from patch to patch, for one thread.
class LoopChainer {
 public:
  /// Chains `walk`, the half-borders that have the patch on their left, end to begin, and finds out which loops bound
  /// the same connected piece of the sphere. No half-borders: a whole sphere is one face; a concave patch then has none
  /// left. What is returned holds each half-border once, and is overwritten by the next call.
  const PatchFaces& chain(std::span<const Border> borders, std::span<const HalfBorder> walk, const glm::dvec3& center,
                          double radius, bool seen_from_inside);

 private:
  struct Sphere {
    glm::dvec3 center;
    double radius;
    bool seen_from_inside;
  };
  void chain_loops(std::span<const Border> borders, std::span<const HalfBorder> walk);
  void list_arcs(std::span<const Border> borders, const Sphere& sphere);
  void group_loops();

  PatchFaces faces_;
  std::vector<std::pair<std::uint32_t, HalfBorder>> open_;  // half-borders by the vertex where they begin
  std::vector<char> taken_;
  std::vector<SphereArc> arcs_;           // of all loops
  std::vector<std::uint32_t> first_arc_;  // of each loop; one past the last closes the list
  std::vector<char> left_;                // loop m, loop k: m lies left of k
};

}  // namespace meniscus
