// SPDX-License-Identifier: BSD-3-Clause
// A formula a kind of patch.
#include "core/queries/curvature.h"
#include "core/surface/primitives.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace meniscus {
namespace {

Curvature of_sphere(double curvature) { return {curvature, curvature * curvature}; }

Curvature of_torus(const ToroidalPatch& t, double probe_radius, const glm::dvec3& point) {
  const glm::dvec3 from_center = point - t.center;
  const double from_axis = glm::length(from_center - glm::dot(from_center, t.axis) * t.axis);
  // R - p cos t is the distance from the axis; on a spindle's inner part, past the axis, there is no surface.
  const double cosine = (t.radius - from_axis) / probe_radius;
  const double along_tube = -1.0 / probe_radius, around_axis = cosine / std::max(from_axis, kCurvatureCore);
  return {0.5 * (along_tube + around_axis), along_tube * around_axis};
}

}  // namespace

Curvature curvature(const Surface& surface, std::uint32_t face, const glm::dvec3& point) {
  const Face& f = surface.faces[face];
  switch (f.kind) {
    case PatchKind::convex:
      return of_sphere(1.0 / surface.atoms[surface.convex[f.patch].atom].radius);
    case PatchKind::toroidal:
      return of_torus(surface.toroidal[f.patch], surface.probe_radius, point);
    default:
      return of_sphere(-1.0 / surface.probe_radius);
  }
}

}  // namespace meniscus
