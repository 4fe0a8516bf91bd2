// SPDX-License-Identifier: BSD-3-Clause
// Every patch as one POV-Ray primitive cut out by clipped_by, with the exact box around it.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/box.h"
#include "core/render/picture.h"
#include "core/surface/primitives.h"
#include "exporters/povray/scene_colors.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {

/// Writes patches relative to `origin` (Å) as primitives cut by clips. The part inside all clips is exactly the patch
/// (theorem 1 of docs/explanation/theory.md):
///  convex    sphere within its planes;
///  toroidal  torus within the visibility sphere (through both contact circles, centred on the axis; it keeps the side
///            that faces the axis) and the wedge of the arc. A spindle is a torus that crosses its axis in two points;
///            it is also outside of the lemon, the ball with these as poles;
///  concave   sphere of the probe within its side planes and the bisectors towards other probes.
/// The clips of toroidal and concave patches end with the patch's exact box, which POV-Ray needs for its bounding
/// hierarchy only.
class PatchObjects {
 public:
  /// clip: planes that cut the whole surface; patches that a plane intersects are clipped by it as well. Keeps
  /// references to the surface, the palette and the planes, which must outlive this object.
  PatchObjects(const Surface& surface, const Palette& palette, const glm::dvec3& origin,
               std::span<const ClipPlane> clip = {})
      : surface_(surface), palette_(palette), origin_(origin), clip_(clip) {}

  /// True if the planes cut away the whole patch.
  bool is_cut_away(const ColoredPiece& piece) const;

  /// Appends one line with the primitive of the piece, which is the part of a patch with one colour and visibility. The
  /// line also cuts away the other pieces of the patch. The piece must not be one that is_cut_away(), or its primitive
  /// would be empty.
  void append(SceneText& out, const ColoredPiece& piece) const;

 private:
  void convex(SceneText& out, const ConvexPatch& patch, std::string_view cuts) const;
  void toroidal(SceneText& out, const ToroidalPatch& patch, std::uint32_t part, std::string_view cuts) const;
  void concave(SceneText& out, const ConcavePatch& patch, std::uint32_t part, std::string_view cuts) const;
  void visibility_sphere(SceneText& out, const ToroidalPatch& patch) const;
  void wedge(SceneText& out, const ToroidalPatch& patch) const;
  /// Appends the half-space of the points that are nearer to the atom of this part; nothing if both atoms are of the
  /// part.
  void part_half(SceneText& out, const ToroidalPatch& patch, std::uint32_t part) const;
  /// Appends the cells of the points that are nearest to an atom of this part; nothing if all atoms are of the part.
  void part_cells(SceneText& out, const ConcavePatch& patch, std::uint32_t part) const;
  void box(SceneText& out, const glm::dvec3& low, const glm::dvec3& high) const;
  /// Appends a half-space. Its written plane is most exact near `anchor`, a point near the patch.
  void plane(SceneText& out, const Plane& plane, const glm::dvec3& anchor) const;
  Box extent(const ColoredPiece& piece) const;
  /// Appends the planes of `clip_` that intersect the box of the piece.
  void cuts(SceneText& out, const ColoredPiece& piece) const;

  const Surface& surface_;
  const Palette& palette_;
  glm::dvec3 origin_;
  std::span<const ClipPlane> clip_;
};

/// Returns the box (Å) of one border arc, from its ends and the points where a coordinate is extreme.
Box arc_extent(const Border& border);

/// Returns the box (Å) of a toroidal patch. A saddle has no extreme point inside because its Gaussian curvature is
/// negative, so the box is that of the borders and, for a free spindle, of the cusp points on the axis.
/// patch.face_count must not be 0: without faces the box would be empty.
Box toroidal_extent(const Surface& surface, const ToroidalPatch& patch);

/// Returns the box (Å) of a concave patch, from its borders and the extreme points of the probe along the coordinate
/// axes that lie inside all planes. patch.face_count must not be 0.
Box concave_extent(const Surface& surface, const ConcavePatch& patch);

}  // namespace meniscus::povray
