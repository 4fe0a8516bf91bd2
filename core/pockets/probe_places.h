// SPDX-License-Identifier: BSD-3-Clause
// Places of a large probe in contact with a molecule, as dense as they are wanted.
#pragma once

#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/box_tree.h"

namespace meniscus {

struct Surface;

/// Whether places of the probe's centre may be wanted that are no farther than `reach` (Å) from a point.
using NearWanted = std::function<bool(const glm::dvec3& point, double reach)>;

/// Å between places, at most: along an arc, and on the sphere of an atom of this radius, where no point is farther from
/// the nearest place than 0.77 of that (spiral.h).
struct PlaceSteps {
  double on_arcs;
  std::function<double(double atom_radius)> on_sphere;
};

/// Every fixed probe, and places along arcs and on faces of the SAS, each of which exactly touches its atoms. Left out
/// are places that are not wanted, and all but the first of those closer than kSamePlace. In the order of the surface's
/// patches. bounds: around all places that are wanted.
std::vector<glm::dvec3> probe_places(const Surface& surface, const PlaceSteps& steps, const Box& bounds,
                                     const NearWanted& wanted);

inline constexpr double kSamePlace = 1e-3;  ///< Å

}  // namespace meniscus
