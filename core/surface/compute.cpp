// SPDX-License-Identifier: BSD-3-Clause
// Reduced surface, then all that is made of it, in as many attempts as ties ask for.
#include "core/surface/reduced_surface_engine.h"
#include "core/surface/surface.h"
#include "core/surface/tie_ladder.h"
#include "core/base/stage_clock.h"

namespace meniscus {

Surface attempt_surface(ReducedSurfaceEngine& engine, std::span<const Ball> atoms, double probe_radius,
                        StageClock& clock, ClipPlanes planes) {
  const ReducedSurface rs = engine.reduce(atoms, probe_radius, clock);
  return assemble_surface(atoms, probe_radius, rs, &clock, &engine.cusp_tracer(), planes);
}

Surface compute_surface(ReducedSurfaceEngine& engine, std::span<const Ball> atoms, double probe_radius,
                        StageClock& clock, ClipPlanes planes) {
  return compute_through_ties(
      atoms, [&](std::span<const Ball> balls) { return attempt_surface(engine, balls, probe_radius, clock, planes); });
}

Surface compute_surface_cpu(std::span<const Ball> atoms, double probe_radius) {
  const auto engine = make_cpu_engine();
  StageClock unused;
  Surface surface = compute_surface(*engine, atoms, probe_radius, unused);
  require_closed(surface);
  return surface;
}

}  // namespace meniscus
