// SPDX-License-Identifier: BSD-3-Clause
// Whether a point lies in the solvent: outside the solid that the surface bounds.
#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus {

/// True if some place where the probe may be is nearer to the point than the probe's radius, or is the point itself:
/// the nearest such place lies on one SAS sphere, on two, or on three, and all of them are tried. A point within 1e-6 Å
/// of the surface may count as not in the solvent; so may one in reach of more than 200 balls, as large probes have
/// them, whose nearest place is a fixed probe.
bool in_solvent(std::span<const Ball> atoms, double probe_radius, const glm::dvec3& point);

}  // namespace meniscus
