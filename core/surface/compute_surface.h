// SPDX-License-Identifier: BSD-3-Clause
// From balls, or from any reduced surface, to the finished solvent-excluded surface with its
// certificate.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/surface/primitives.h"

namespace meniscus {

class ConvexPlanes;
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

/// The tables of the same, neither measured nor certified. Certificate::open_atoms names atoms at which they do not
/// close; if no probe could be placed there are no faces.
Surface build_surface(std::span<const Ball> atoms, double probe_radius, const ReducedSurface& rs, StageClock& clock,
                      CuspTracer& tracer, ClipPlanes planes, const ReducedComponents* cut_within = nullptr);

/// The planes of a surface that was built with this choice. Surface and reduced surface live longer.
std::unique_ptr<ConvexPlanes> planes_for(ClipPlanes planes, const Surface& surface, const ReducedSurface& rs);

/// Throws OpenSurfaceError, naming atoms by their index, unless the certificate says the surface is closed.
void require_closed(const Surface& surface);

/// Throws std::logic_error if the tables of borders and faces were let go (Surface::sums): before a mesh of nothing is
/// taken for that of the surface.
void require_borders(const Surface& surface);

/// The reduced surface by `engine` and all that follows from it, for the balls as they are; look at its certificate.
/// atoms: vdW balls in Å; probe_radius >= 0 in Å. Adds the time of each stage to `clock`. Throws GpuError,
/// CapacityError.
Surface attempt_surface(ReducedSurfaceEngine& engine, std::span<const Ball> atoms, double probe_radius,
                        StageClock& clock, ClipPlanes planes = ClipPlanes::listed);

/// The same in as many attempts as ties ask for.
Surface compute_surface(ReducedSurfaceEngine& engine, std::span<const Ball> atoms, double probe_radius,
                        StageClock& clock, ClipPlanes planes = ClipPlanes::listed);

/// The complete surface in double precision on the CPU, on all cores TBB may use.
/// atoms: vdW balls in Å; probe_radius >= 0 in Å. Throws OpenSurfaceError, CapacityError.
Surface compute_surface_cpu(std::span<const Ball> atoms, double probe_radius);

/// How often a surface is computed at most: once as given, then for grown radii, by 0.016 Å in the last. Growth of more
/// than 1e-4 Å is for probes of 50 Å and more that touch dozens of atoms at once: rounding is as much larger as they
/// are.
inline constexpr int kTieAttempts = 15;

/// The largest growth of that attempt, Å: 0 for attempt 0, then from 1e-8 Å upwards, each three times the last.
double tie_growth(int attempt);

/// The radius of an attempt, of a ball with this index.
double grown_radius(double radius, std::size_t index, int attempt);

/// The balls of an attempt: radii grown by half to all of tie_growth(attempt), by another amount for each index.
std::vector<Ball> grown_balls(std::span<const Ball> balls, int attempt);

/// Decisions are taken for radii that grow by about 1e-9 Å (decision_weights()), positions computed from the given
/// ones. Where many spheres meet in one point, nearly or exactly, what the decisions see as a figure of 1e-9 Å may be
/// turned inside out in the positions; the certificate then refuses it. Radii that truly grow by more than decisions do
/// leave no tie, so decisions and positions are of one and the same figure. Touching still counts as overlapping.
/// compute: balls -> Surface. Returns the first attempt whose certificate holds, with Certificate::grown_by set, else
/// the result of attempt 0.
template <typename Compute>
Surface compute_through_ties(std::span<const Ball> balls, const Compute& compute) {
  Surface surface = compute(balls);
  if (surface.certificate.closed) return surface;
  for (int attempt = 1; attempt < kTieAttempts; ++attempt) {
    surface = {};  // before the next one takes as much memory
    surface = compute(std::span<const Ball>(grown_balls(balls, attempt)));
    if (!surface.certificate.closed) continue;
    surface.certificate.grown_by = tie_growth(attempt);
    surface.certificate.exact_within += tie_growth(attempt);
    return surface;
  }
  surface = {};
  return compute(balls);
}

}  // namespace meniscus
