// SPDX-License-Identifier: BSD-3-Clause
// Computes the complete reduced surface by exhaustive enumeration on the CPU: every circle of every pair of overlapping
// atoms.
#pragma once

#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

/// Enumerates the reduced surface. atoms in Å, probe_radius >= 0 in Å; numbers: for atoms taken out of a larger set.
/// Runs on all cores that TBB may use; the result does not depend on their number.
ReducedSurface enumerate_reduced_surface(std::span<const Ball> atoms, double probe_radius, CircleStats* stats = nullptr,
                                         AtomNumbers numbers = {});

}  // namespace meniscus
