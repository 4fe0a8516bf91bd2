// SPDX-License-Identifier: BSD-3-Clause
// The complete reduced surface by exhaustive enumeration on the CPU: every circle of every pair of overlapping atoms.
#pragma once

#include <span>

#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

/// atoms in Å, probe_radius >= 0 in Å; numbers: of atoms that are part of more. Works on all cores TBB may use; the
/// result does not depend on their number.
ReducedSurface enumerate_reduced_surface(std::span<const Ball> atoms, double probe_radius, CircleStats* stats = nullptr,
                                         AtomNumbers numbers = {});

}  // namespace meniscus
