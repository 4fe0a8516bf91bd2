// SPDX-License-Identifier: BSD-3-Clause
// Area and enclosed volume in closed form.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/surface/primitives.h"

namespace meniscus {

class ConvexPlanes;

/// Faces by the trust in their areas.
struct MeasurementDoubts {
  std::vector<std::uint32_t> doubtful;  ///< corners do not fit their circles: measured by a second closed form
  std::vector<std::uint32_t> disputed;  ///< those of them on whose area the two closed forms do not agree
};

/// Half-way between the outermost centres: from there volumes are measured, so that rounding is least.
glm::dvec3 middle_of(std::span<const Ball> atoms);

/// What faces contribute to their components, beside Face::area.
struct MeasuredFaces {
  std::vector<double>
      flux;  ///< of each face: the integral of x·n over it, Å³; a third of it is its share of the volume
  MeasurementDoubts doubts;
};

/// Fills in Face::area. origin: x of the integrals is measured from it.
MeasuredFaces measure_faces(Surface& surface, const glm::dvec3& origin, const ConvexPlanes& planes);

/// Sorts components as they are listed: outer ones first, then cavities, each by falling area. Returns the new place of
/// each.
std::vector<std::uint32_t> sort_components(std::vector<Component>& components);

/// Fills in Face::area, Component::{area, volume, kind}, Surface::{area, volume}, and sorts the components: outer ones
/// first, then cavities, each by falling area. Areas by Gauss-Bonnet, volumes by the divergence theorem; both are
/// sums of closed forms over borders, so the error is rounding only. Where ties have left a face with corners beside
/// its circles its area is integrated about a pole instead, which needs no tangents.
MeasurementDoubts measure_surface(Surface& surface, const ConvexPlanes& planes);
MeasurementDoubts measure_surface(Surface& surface);  ///< by the planes that its tables list

/// Tube angles of a torus: the latitude on the probe, from the direction to the axis towards atom[1].
/// Those of the contacts with atom[0] and atom[1].
std::array<double, 2> contact_tube_angles(const Surface& surface, const ToroidalPatch& patch);
/// Those between which the patch's n-th face lies, the lower one first.
std::array<double, 2> tube_range(const Surface& surface, const ToroidalPatch& patch, std::uint32_t n);
/// Integrals over the patch between two tube angles, per radian around the axis: of 1, of the tube angle's cosine and
/// of its sine, Å².
glm::dvec3 toroidal_moments(const Surface& surface, const ToroidalPatch& patch, double low, double high);
/// Area of the patch between two tube angles, Å².
double toroidal_area(const Surface& surface, const ToroidalPatch& patch, double low, double high);

}  // namespace meniscus
