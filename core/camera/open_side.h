// SPDX-License-Identifier: BSD-3-Clause
// The side from which some atoms are hidden least by the others: into a pocket, at a ligand.
#pragma once

#include <span>

#include "core/camera/camera.h"
#include "core/math/ball.h"

namespace meniscus {

/// Axes of a picture from that side; the longest extent of `seen` across the view lies horizontally. seen: at least one
/// ball. all: with those of `seen` among them or not. Of directions spread over the sphere the one along which most
/// points on the balls of `seen` are free of the others, or, where several have as many, along which the covered points
/// lie least deep. Points and directions are samples: about 500 of each.
ViewBasis open_side(std::span<const Ball> seen, std::span<const Ball> all);

}  // namespace meniscus
