// SPDX-License-Identifier: BSD-3-Clause
// How much of a surface a volume map covers.
#pragma once

#include <span>

#include "core/color/color_maps.h"
#include "core/queries/surface_object.h"

namespace meniscus {

/// The share in [0, 1] of the area that shows a volume map's colours and lies where the map has no values, measured
/// at points of all patches: 0 exactly where atoms lie deep enough in the map; 0 if nothing shows its colours.
double share_beyond(const VolumePaint& map, std::span<const SurfaceObject> objects);

}  // namespace meniscus
