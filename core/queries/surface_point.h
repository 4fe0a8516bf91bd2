// SPDX-License-Identifier: BSD-3-Clause
// Computes properties of a point in closed form: the curvature of its patch, and whether it lies in the solvent.
#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus {

/// The curvature by the principal curvatures k1, k2 with the normal towards the solvent, positive where the solid
/// bulges.
struct Curvature {
  double mean = 0.0;      ///< (k1 + k2) / 2, 1/Å
  double gaussian = 0.0;  ///< k1 k2, 1/Å²
};

/// The distance (Å) from the axis of a spindle torus below which curvatures are those at this distance: the second one
/// grows without bound towards the tip.
inline constexpr double kCurvatureCore = 0.001;

/// Returns the curvature at a point (Å) of a face. On an atom of radius r both principal curvatures are 1/r, on a fixed
/// probe of radius p -1/p. On a torus of major radius R, at the angle t of its tube from the axis, they are -1/p and
/// cos t / (R - p cos t) (do Carmo, "Differential geometry of curves and surfaces", 1976, section 3.3, example 5).
Curvature curvature(const Surface& surface, std::uint32_t face, const glm::dvec3& point);

/// True if some place of the probe is nearer to the point (Å) than the probe's radius, or is the point itself. The
/// nearest such place lies on one SAS sphere, on two, or on three, and all of these are tried. A point within 1e-6 Å of
/// the surface may count as not in the solvent. So may a point in reach of more than 200 balls, as large probes have
/// them, if its nearest place is a fixed probe.
bool in_solvent(std::span<const Ball> atoms, double probe_radius, const glm::dvec3& point);

}  // namespace meniscus
