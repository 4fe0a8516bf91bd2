// SPDX-License-Identifier: BSD-3-Clause
// The boundary representation: vertices, borders, loops, faces and components from placed patches.
#pragma once

#include <span>

#include "core/surface/cusps.h"
#include "core/surface/fixed_probes.h"
#include "core/surface/primitives.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

/// Computes surface.vertices, borders, half_borders, loops, faces and components (without kinds and areas, which
/// measure_surface adds) and the face ranges of the patches. `surface` holds atoms, toroidal and concave patches;
/// `probes` and `cusps` are the tables that they were made from. Adds atoms to the certificate where borders do not
/// close.
void build_boundary(Surface& surface, const FixedProbes& probes, const CuspParts& cusps, const ReducedSurface& rs);

}  // namespace meniscus
