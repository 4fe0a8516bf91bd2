// SPDX-License-Identifier: BSD-3-Clause
// The connected components of a surface, their Euler characteristics, and on which side of each the solid lies.
#pragma once

#include <limits>
#include <vector>

#include "core/surface/primitives.h"

namespace meniscus {

class ConvexPlanes;

struct Surface;

/// Fills in Face::component, Component::euler and as many components as there are, in the order of their first faces.
/// Two faces are connected where they share a border; a border with one face or none connects nothing. Returns whether
/// each border has two.
bool connect_components(Surface& surface);

/// How far a component reaches in one direction: its borders, the poles of its convex patches, those of its concave
/// ones, Å; minus infinity: it has none.
struct Farthest {
  double border = -std::numeric_limits<double>::infinity();
  double convex = border;
  double concave = border;

  void include(const Farthest& other);
};

/// Of each component, as far as it decides the component's side: a pole counts only where it is beyond the others.
std::vector<Farthest> farthest_of_components(const Surface& surface, const ConvexPlanes& planes);

/// Outer component or cavity, by an argument that needs neither areas nor volumes. Let x be a component's farthest
/// point in a direction that is not special. A cavity is a union of probes, so x is the pole of the farthest one and
/// lies inside a concave patch. The solid within an outer component ends at x, while at the pole of a concave patch it
/// begins; so x is the pole of a convex patch, or lies on a border. With a probe of radius 0 there are no concave
/// patches, and x is the pole of a convex patch exactly where the component is an outer one.
ComponentKind side_of(const Farthest& farthest, double probe_radius);

/// Of each component. Needs Face::component, the patches' planes and the borders.
std::vector<ComponentKind> side_of_components(const Surface& surface, const ConvexPlanes& planes);

}  // namespace meniscus
