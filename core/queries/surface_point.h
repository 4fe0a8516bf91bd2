// SPDX-License-Identifier: BSD-3-Clause
// Properties of a point in closed form: the curvature of its patch, and whether it lies in the solvent.
#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus {

struct Surface;

/// Of principal curvatures k1, k2 with the normal towards the solvent, positive where the solid bulges.
struct Curvature {
  double mean = 0.0;      ///< (k1 + k2) / 2, 1/Å
  double gaussian = 0.0;  ///< k1 k2, 1/Å²
};

/// Within this (Å) of the axis of a spindle torus, whose second curvature grows without bound towards its tip,
/// curvatures are those at this distance.
inline constexpr double kCurvatureCore = 0.001;

/// At a point (Å) of this face. On an atom of radius r both principal curvatures are 1/r, on a fixed probe -1/p; on a
/// torus of major radius R, at the angle t of its tube from the axis, they are -1/p and cos t / (R - p cos t) (do
/// Carmo, "Differential geometry of curves and surfaces", 1976, section 3.3, example 5).
Curvature curvature(const Surface& surface, std::uint32_t face, const glm::dvec3& point);

/// True if some place where the probe may be is nearer to the point than the probe's radius, or is the point itself:
/// the nearest such place lies on one SAS sphere, on two, or on three, and all of them are tried. A point within 1e-6 Å
/// of the surface may count as not in the solvent; so may one in reach of more than 200 balls, as large probes have
/// them, whose nearest place is a fixed probe.
bool in_solvent(std::span<const Ball> atoms, double probe_radius, const glm::dvec3& point);

}  // namespace meniscus
