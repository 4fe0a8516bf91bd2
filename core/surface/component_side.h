// SPDX-License-Identifier: BSD-3-Clause
// On which side of a component the solid lies, told from its farthest point alone.
#pragma once

#include <vector>

#include "core/surface/primitives.h"

namespace meniscus {

/// Outer component or cavity, by an argument that needs neither areas nor volumes. Let x be a component's farthest
/// point in a direction that is not special. A cavity is a union of probes, so x is the pole of the farthest one and
/// lies inside a concave patch. The solid within an outer component ends at x, while at the pole of a concave patch it
/// begins; so x is the pole of a convex patch, or lies on a border. With a probe of radius 0 there are no concave
/// patches, and x is the pole of a convex patch exactly where the component is an outer one.
/// Returns one kind per component. Needs Face::component, the patches' planes and the borders.
std::vector<ComponentKind> side_of_components(const Surface& surface, const ConvexPlanes& planes);

}  // namespace meniscus
