// SPDX-License-Identifier: BSD-3-Clause
// Exact axis-aligned boxes of curved patches, from their borders and the points where a coordinate is extreme inside.
#pragma once

#include "core/math/box.h"
#include "core/surface/primitives.h"

namespace meniscus::povray {

/// The box of one border arc: its ends and the points where a coordinate turns.
Box arc_extent(const Border& border);

/// A saddle has no extreme point inside (its Gaussian curvature is negative), so its box is that of its borders and,
/// for a free spindle, of the cusp points on the axis. The patch needs face_count > 0.
Box toroidal_extent(const Surface& surface, const ToroidalPatch& patch);

/// The box of the borders and of those poles of the probe that lie inside all planes. The patch needs face_count > 0.
Box concave_extent(const Surface& surface, const ConcavePatch& patch);

}  // namespace meniscus::povray
