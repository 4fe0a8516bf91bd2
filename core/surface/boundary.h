// SPDX-License-Identifier: BSD-3-Clause
// The boundary representation: vertices, borders, loops, faces and components from placed patches.
#pragma once

#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/cusps.h"
#include "core/surface/fixed_probes.h"
#include "core/surface/primitives.h"
#include "core/surface/spherical.h"

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

/// Computes surface.vertices, borders, half_borders, loops, faces and components (without kinds and areas, which
/// measure_surface adds) and the face ranges of the patches. `surface` holds atoms, toroidal and concave patches;
/// `probes` and `cusps` are the tables that they were made from. Adds atoms to the certificate where borders are open.
void build_boundary(Surface& surface, const FixedProbes& probes, const CuspParts& cusps, const ReducedSurface& rs);

}  // namespace meniscus
