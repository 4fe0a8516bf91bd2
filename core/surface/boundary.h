// SPDX-License-Identifier: BSD-3-Clause
// The boundary representation: vertices, borders, loops, faces and components from placed patches.
#pragma once

#include <span>

#include "core/surface/cusps.h"
#include "core/surface/fixed_probes.h"
#include "core/surface/primitives.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

/// Fills in surface.vertices, borders, half_borders, loops, faces and components (kinds and areas come later, from
/// measure_surface) and the patches' face ranges. `surface` holds atoms, toroidal and concave patches; `probes` and
/// `cusps` are what they were made of. Adds atoms to the certificate where borders do not close.
void build_boundary(Surface& surface, const FixedProbes& probes, const CuspParts& cusps, const ReducedSurface& rs);

}  // namespace meniscus
