// SPDX-License-Identifier: BSD-3-Clause
// Finds the reduced surface by a probe that rolls from face to face (Sanner, Olson & Spehner 1996, section 3.1).
#pragma once

#include <span>

#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

/// The part of the surface that the probe explores.
enum class RollingScope {
  /// The part that rolling over edges reaches from the leftmost atom: one component, no cavities. The classical
  /// algorithm.
  outer_component,
  /// Everything. Rolling cannot leave its component, so each circle of two atoms is searched for positions where the
  /// probe touches a third atom; at each unvisited position it starts again. Free edges, to which no face leads, are
  /// found on the way. The result equals enumerate_reduced_surface().
  complete
};

/// Rolls a probe over the atoms, in one thread. atoms in Å, probe_radius >= 0 in Å. It shares decision weights and
/// predicates with the contour build-up but neither its search nor its bookkeeping, and so checks it.
ReducedSurface roll_probe(std::span<const Ball> atoms, double probe_radius,
                          RollingScope scope = RollingScope::complete);

}  // namespace meniscus
