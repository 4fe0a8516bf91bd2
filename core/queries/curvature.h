// SPDX-License-Identifier: BSD-3-Clause
// The curvature of the surface at a point of one of its patches, in closed form.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

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

}  // namespace meniscus
