// SPDX-License-Identifier: BSD-3-Clause
// The surface on the CPU from end to end.
#include "core/reduced_surface/cpu/exhaustive.h"
#include "core/surface/surface.h"
#include "core/surface/tie_ladder.h"

namespace meniscus {

Surface compute_surface_cpu(std::span<const Ball> atoms, double probe_radius) {
  Surface surface = compute_through_ties(atoms, [&](std::span<const Ball> balls) {
    return assemble_surface(balls, probe_radius, enumerate_reduced_surface(balls, probe_radius));
  });
  require_closed(surface);
  return surface;
}

}  // namespace meniscus
