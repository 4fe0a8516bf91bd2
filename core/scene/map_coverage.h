// SPDX-License-Identifier: BSD-3-Clause
// The share of a surface that a volume map covers.
#pragma once

#include <span>

#include "core/color/color_maps.h"
#include "core/queries/surface_object.h"

namespace meniscus {

/// Returns the share in [0, 1] of the area with a volume map's colours that lies where the map has no values, measured
/// at points of all patches. It is exactly 0 if the atoms lie deep enough in the map, and 0 if nothing shows its
/// colours.
double share_beyond(const VolumePaint& map, std::span<const SurfaceObject> objects);

}  // namespace meniscus
