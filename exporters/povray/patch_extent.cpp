// SPDX-License-Identifier: BSD-3-Clause
// Extents of circle arcs, saddle patches and re-entrant patches in closed form.
#include "exporters/povray/patch_extent.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/surface/walks.h"

namespace meniscus::povray {
namespace {

// Extremes this far outside of an arc or a plane are still taken in: the box may be too large, never too small.
constexpr double kGenerous = 1e-9;

void include_face(Box& box, const Surface& surface, const Face& face) {
  for_each_border(surface, face, [&](const Border& border) {
    const Box arc = arc_extent(border);
    box.include(arc.low);
    box.include(arc.high);
  });
  if (face.tip != kNone) box.include(surface.vertices[face.tip]);
}

}  // namespace

Box arc_extent(const Border& b) {
  const glm::dvec3 side = glm::cross(b.axis, b.start);
  Box box;
  box.include(arc_point(b, 0.0));
  box.include(arc_point(b, b.sweep));
  for (int k = 0; k < 3; ++k) {
    const double turn = std::atan2(side[k], b.start[k]);  // the coordinate is largest here, least half a turn on
    for (const double t : {turn, turn + std::numbers::pi}) {
      const double from_start = t < -kGenerous ? t + 2.0 * std::numbers::pi : t;
      if (from_start <= b.sweep + kGenerous) box.include(arc_point(b, from_start));
    }
  }
  return box;
}

Box toroidal_extent(const Surface& surface, const ToroidalPatch& patch) {
  Box box;
  for (const Face& face : faces_of(surface, patch)) include_face(box, surface, face);
  return box;
}

Box concave_extent(const Surface& surface, const ConcavePatch& patch) {
  Box box;
  for (const Face& face : faces_of(surface, patch)) include_face(box, surface, face);
  for (int k = 0; k < 3; ++k)
    for (const double sign : {-1.0, 1.0}) {
      glm::dvec3 pole = patch.center;
      pole[k] += sign * surface.probe_radius;
      bool inside = true;
      for (std::uint32_t n = 0; n < patch.plane_count(); ++n) {
        const Plane& plane = surface.planes[patch.first_plane + n];
        inside = inside && glm::dot(plane.normal, pole) <= plane.offset + kGenerous;
      }
      if (inside) box.include(pole);
    }
  return box;
}

}  // namespace meniscus::povray
