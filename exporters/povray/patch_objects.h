// SPDX-License-Identifier: BSD-3-Clause
// Every patch as one POV-Ray primitive cut out by clipped_by: sphere, torus, or the sphere of a fixed probe.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"
#include "exporters/povray/palette.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {

/// Writes patches relative to `origin`. What is inside all clips is exactly the patch (theorem 1):
///  convex    sphere within its planes;
///  toroidal  torus within the visibility sphere (through both contact circles, centred on the axis; it keeps the side
///            that faces the axis), the wedge of the arc, and outside of the lemon where a spindle crosses its axis;
///  concave   sphere of the probe within its side planes and the bisectors towards other probes.
/// Curved patches end with their exact box, which POV-Ray needs for its bounding hierarchy only.
/// The result keeps references to its arguments.
class PatchObjects {
 public:
  PatchObjects(const Surface& surface, const Palette& palette, const glm::dvec3& origin)
      : surface_(surface), palette_(palette), origin_(origin) {}

  /// One line: the primitive of the piece, with a cut towards other parts of the same patch, of other colours or
  /// hidden.
  void append(SceneText& out, const ColoredPiece& piece) const;

 private:
  void convex(SceneText& out, const ConvexPatch& patch) const;
  void toroidal(SceneText& out, const ToroidalPatch& patch, std::uint32_t part) const;
  void concave(SceneText& out, const ConcavePatch& patch, std::uint32_t part) const;
  void visibility_sphere(SceneText& out, const ToroidalPatch& patch) const;
  void wedge(SceneText& out, const ToroidalPatch& patch) const;
  void part_half(SceneText& out, const ToroidalPatch& patch, std::uint32_t part) const;
  void part_cells(SceneText& out, const ConcavePatch& patch, std::uint32_t part) const;
  void box(SceneText& out, const glm::dvec3& low, const glm::dvec3& high) const;
  void plane(SceneText& out, const Plane& plane, const glm::dvec3& anchor) const;

  const Surface& surface_;
  const Palette& palette_;
  glm::dvec3 origin_;
};

}  // namespace meniscus::povray
