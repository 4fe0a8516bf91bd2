// SPDX-License-Identifier: BSD-3-Clause
// Places of a large probe in contact with a molecule, so dense that they stand for all of them.
#pragma once

#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus {

/// Whether places of the probe's centre may be wanted that are no farther than `reach` (Å) from a point.
using NearWanted = std::function<bool(const glm::dvec3& point, double reach)>;

/// Every fixed probe, and places along arcs and on faces of the SAS, each of which exactly touches its atoms: no place
/// of the probe where it touches an atom is farther than `spacing` (Å) from one of these. Left out are places that are
/// not wanted, and all but the first of those closer than kSamePlace. In the order of the surface's patches.
std::vector<glm::dvec3> probe_places(const Surface& surface, double spacing, const NearWanted& wanted);

inline constexpr double kSamePlace = 1e-3;  ///< Å

}  // namespace meniscus
