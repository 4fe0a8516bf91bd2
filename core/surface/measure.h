// SPDX-License-Identifier: BSD-3-Clause
// Area and enclosed volume of the surface in closed form.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/surface/primitives.h"

namespace meniscus {

class ConvexPlanes;

/// The faces whose areas are doubtful.
struct MeasurementDoubts {
  std::vector<std::uint32_t> doubtful;  ///< corners do not fit their circles; measured by a second closed form
  std::vector<std::uint32_t> disputed;  ///< the doubtful faces for which the two closed forms disagree
};

/// Returns the point half-way between the outermost centres, Å. Volumes are measured from there, where rounding is
/// least.
glm::dvec3 middle_of(std::span<const Ball> atoms);

/// The contributions of faces to their components, in addition to Face::area.
struct MeasuredFaces {
  std::vector<double>
      flux;  ///< per face: the integral of x·n over it, Å³; a third of it is the face's part of the volume
  MeasurementDoubts doubts;
};

/// Computes Face::area. origin: the point from which the integrals measure x.
MeasuredFaces measure_faces(Surface& surface, const glm::dvec3& origin, const ConvexPlanes& planes);

/// Sorts components into the order of the list: outer ones first, then cavities, each by falling area. Returns the new
/// index of each.
std::vector<std::uint32_t> sort_components(std::vector<Component>& components);

/// Computes Face::area, Component::{area, volume, kind} and Surface::{area, volume}, and sorts the components: outer
/// ones first, then cavities, each by falling area. Areas follow from Gauss-Bonnet, volumes from the divergence
/// theorem. Both are sums of closed forms over borders, so the only error is rounding. Where ties have left a face with
/// corners off its circles, its area is integrated about a pole instead, which needs no tangents.
MeasurementDoubts measure_surface(Surface& surface, const ConvexPlanes& planes);
MeasurementDoubts measure_surface(Surface& surface);  ///< uses the clip planes listed in the surface's tables

/// Returns the tube angles of the contacts with atom[0] and atom[1]. A tube angle is the latitude on the probe,
/// measured from the direction to the axis towards atom[1].
std::array<double, 2> contact_tube_angles(const Surface& surface, const ToroidalPatch& patch);
/// Returns the tube angles between which the patch's n-th face lies, the lower one first.
std::array<double, 2> tube_range(const Surface& surface, const ToroidalPatch& patch, std::uint32_t n);
/// Returns the integrals of 1, of the tube angle's cosine and of its sine over the patch between two tube angles, per
/// radian around the axis, Å².
glm::dvec3 toroidal_moments(const Surface& surface, const ToroidalPatch& patch, double low, double high);
/// Returns the area of the patch between two tube angles, Å².
double toroidal_area(const Surface& surface, const ToroidalPatch& patch, double low, double high);

}  // namespace meniscus
