// SPDX-License-Identifier: BSD-3-Clause
// The connected components of a surface, their Euler characteristics, and the side of each on which the solid lies.
#pragma once

#include "core/surface/primitives.h"

namespace meniscus {

class ConvexPlanes;

/// Computes Face::component, Component::euler and the list of components, in the order of their first faces. Two faces
/// are connected where they share a border; a border with fewer than two faces connects nothing. Returns true if each
/// border has two faces.
bool connect_components(Surface& surface);

/// The extent of a component in one direction, Å: of its borders, of the poles of its convex patches, and of the poles
/// of its concave patches. Minus infinity: it has none.
struct Farthest {
  double border = -std::numeric_limits<double>::infinity();
  double convex = border;
  double concave = border;

  void include(const Farthest& other);
};

/// Returns the extent of each component as far as it decides the component's side: a pole counts only where it is
/// farther out than the others.
std::vector<Farthest> farthest_of_components(const Surface& surface, const ConvexPlanes& planes);

/// Decides between outer component and cavity by an argument that needs neither areas nor volumes. Let x be a
/// component's farthest point in a generic direction. A cavity is a union of probes, so x is the pole of the farthest
/// one and lies inside a concave patch. The solid within an outer component ends at x, while the solid begins at the
/// pole of a concave patch; so x is the pole of a convex patch, or lies on a border. With a probe of radius 0 there are
/// no concave patches, and x is the pole of a convex patch exactly where the component is an outer one.
ComponentKind side_of(const Farthest& farthest, double probe_radius);

/// Decides the side of each component. Face::component, the patches' planes and the borders must be there.
std::vector<ComponentKind> side_of_components(const Surface& surface, const ConvexPlanes& planes);

}  // namespace meniscus
