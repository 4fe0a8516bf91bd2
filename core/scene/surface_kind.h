// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of every kind as solvent-excluded ones, which engines compute and renderers draw.
#pragma once

#include <span>
#include <vector>

#include "core/math/ball.h"
#include "core/scene/surface_request.h"

namespace meniscus {

/// What the balls grow by (Å) before a probe rolls over them.
double growth_of(SurfaceKind kind, double probe_radius);
/// The radius (Å) of the probe that rolls over the grown balls; 0: the surface is theirs.
double rolling_probe(SurfaceKind kind, double probe_radius);

/// The balls with radii larger by `growth` (Å).
std::vector<Ball> grown(std::span<const Ball> balls, double growth);

/// Throws RequestError where a probe is named for a surface that has none.
void require_probe_of_kind(const SurfaceRequest& request);

}  // namespace meniscus
