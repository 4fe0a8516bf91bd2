// SPDX-License-Identifier: BSD-3-Clause
// Chains the half-borders of one spherical patch to loops, and groups the loops into connected faces.
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
  std::vector<HalfBorder> half_borders;   ///< the half-borders of all loops, loop after loop
  std::vector<std::uint32_t> loop_sizes;  ///< number of half-borders in each loop
  std::vector<std::uint32_t> loop_face;   ///< face of each loop, counted within the patch
  std::uint32_t face_count = 0;
  bool closed = true;  ///< false if a walk does not return to its beginning
};

/// Finds loops and faces of one patch after another. It reuses its lists from patch to patch and belongs to one thread.
class LoopChainer {
 public:
  /// Chains `walk`, the half-borders with the patch on their left, end to begin, and groups loops that bound the same
  /// connected piece of the sphere. Without half-borders, a convex patch is a whole sphere with one face, and a concave
  /// patch has no face left. The result contains each half-border once and is overwritten by the next call.
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
  std::vector<SphereArc> arcs_;           // the arcs of all loops
  std::vector<std::uint32_t> first_arc_;  // first arc of each loop; one past the last closes the list
  std::vector<char> left_;                // for loops m and k: true if m lies left of k
};

}  // namespace meniscus
