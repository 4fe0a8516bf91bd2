// SPDX-License-Identifier: BSD-3-Clause
// From a reduced surface, however it was found, to the finished solvent-excluded surface with its certificate.
#pragma once

#include <span>

#include "core/surface/primitives.h"

namespace meniscus {

class CuspTracer;
class ReducedSurfaceEngine;
class StageClock;
struct ReducedComponents;
struct ReducedSurface;

/// Whether a surface gets the clip planes of its convex patches (ConvexPatch::planes), a fifth of the work.
enum class ClipPlanes {
  listed,   ///< it can be drawn, exported and divided
  left_out  ///< no convex patch has any: for numbers, borders and areas. The certificate is as strict
};

/// Builds all patches, their borders, faces and components, their areas and volumes (closed form) and the certificate.
/// `rs` must have been computed for the same `atoms` and `probe_radius`.
/// Look at the result's certificate, or call require_closed(), before using it.
/// Adds the time of each stage to `clock` if there is one. Singularities are traced by `tracer`, by default on the CPU.
/// With `cut_within`, of this very reduced surface, a probe cuts patches of its own component only
/// (reduced_components.h), and a component's sheet may then run through another's.
Surface assemble_surface(std::span<const Ball> atoms, double probe_radius, const ReducedSurface& rs,
                         StageClock* clock = nullptr, CuspTracer* tracer = nullptr,
                         ClipPlanes planes = ClipPlanes::listed, const ReducedComponents* cut_within = nullptr);

/// Throws OpenSurfaceError, naming atoms by their index, unless the certificate says the surface is closed.
void require_closed(const Surface& surface);

/// The reduced surface by `engine` and all that follows from it, for the balls as they are; look at its certificate.
/// atoms: vdW balls in Å; probe_radius >= 0 in Å. Adds the time of each stage to `clock`. Throws GpuError,
/// CapacityError.
Surface attempt_surface(ReducedSurfaceEngine& engine, std::span<const Ball> atoms, double probe_radius,
                        StageClock& clock, ClipPlanes planes = ClipPlanes::listed);

/// The same in as many attempts as ties ask for (tie_ladder.h).
Surface compute_surface(ReducedSurfaceEngine& engine, std::span<const Ball> atoms, double probe_radius,
                        StageClock& clock, ClipPlanes planes = ClipPlanes::listed);

/// The complete surface in double precision on the CPU, on all cores TBB may use.
/// atoms: vdW balls in Å; probe_radius >= 0 in Å. Throws OpenSurfaceError, CapacityError.
Surface compute_surface_cpu(std::span<const Ball> atoms, double probe_radius);

}  // namespace meniscus
