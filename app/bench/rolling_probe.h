// SPDX-License-Identifier: BSD-3-Clause
// The reduced surface as Sanner, Olson & Spehner 1996 (section 3.1) find it: a probe that rolls from face to face.
#pragma once

#include <span>

#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

/// How far the probe gets.
enum class RollingScope {
  /// What rolling over edges reaches from the leftmost atom: one component, no cavities. The classical algorithm.
  outer_component,
  /// Everything. Rolling cannot leave its component, so each circle of two atoms is asked whether the probe can be
  /// where a third atom meets it; where it can and has not been, it starts again. Free edges, to which no face leads,
  /// are found on the way. The result equals enumerate_reduced_surface().
  complete
};

/// atoms in Å, probe_radius >= 0 in Å. One thread; it shares decision weights and predicates with the contour
/// build-up but neither its search nor its bookkeeping, and so checks it.
ReducedSurface roll_probe(std::span<const Ball> atoms, double probe_radius,
                          RollingScope scope = RollingScope::complete);

}  // namespace meniscus
