// SPDX-License-Identifier: BSD-3-Clause
// Computes the solvent-excluded surface with its certificate, on the CPU or the GPU.
#pragma once

#include "core/gpu/device_choice.h"
#include "core/gpu/program.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/cusp_tracer.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Finds reduced surfaces on one device, frame after frame. All engines find the same. One thread uses it at a time.
class ReducedSurfaceEngine {
 public:
  virtual ~ReducedSurfaceEngine() = default;

  /// Finds the reduced surface. atoms: van der Waals balls in Å; probe_radius >= 0 in Å. Adds the time of each stage to
  /// `clock`, with batches added up. Throws GpuError, CapacityError.
  virtual ReducedSurface reduce(std::span<const Ball> atoms, double probe_radius, StageClock& clock) = 0;

  /// Returns the tracer on the same device. It lives as long as the engine.
  virtual CuspTracer& cusp_tracer() = 0;

  /// Returns the statistics of the last reduce().
  virtual const CircleStats& stats() const = 0;

  /// Returns the device's name for people: "cpu (16 threads)", or GL renderer and version.
  virtual std::string device() const = 0;
};

/// Makes an engine on all cores that TBB may use, in double and, where in doubt, quadruple precision. The result does
/// not depend on the number of cores.
std::unique_ptr<ReducedSurfaceEngine> make_cpu_engine();

class ConvexPlanes;
struct ReducedComponents;

/// Builds all patches, their borders, faces and components, their areas and volumes (closed form) and the certificate.
/// `rs` must have been computed for the same `atoms` and `probe_radius`. Look at the result's certificate, or call
/// require_closed(), before using it. Adds the time of each stage to `clock`, if there is one. Singularities are traced
/// by `tracer`, by default on the CPU. With `cut_within`, which belongs to this reduced surface, a probe cuts only
/// patches of its own component (reduced_components.h), and a component's sheet may then intersect another's.
Surface assemble_surface(std::span<const Ball> atoms, double probe_radius, const ReducedSurface& rs,
                         StageClock* clock = nullptr, CuspTracer* tracer = nullptr,
                         ClipPlanes planes = ClipPlanes::listed, const ReducedComponents* cut_within = nullptr);

/// Builds the tables of the surface without measuring or certifying them. Certificate::open_atoms names atoms at which
/// the tables do not close; if no probe could be placed there are no faces.
Surface build_surface(std::span<const Ball> atoms, double probe_radius, const ReducedSurface& rs, StageClock& clock,
                      CuspTracer& tracer, ClipPlanes planes, const ReducedComponents* cut_within = nullptr);

/// Returns the planes of a surface that was built with this choice. Both surfaces must outlive the result.
std::unique_ptr<ConvexPlanes> planes_for(ClipPlanes planes, const Surface& surface, const ReducedSurface& rs);

/// Lists the planes that ClipPlanes::deferred has put off, so that the surface equals one with ClipPlanes::listed. Does
/// nothing for other surfaces.
void list_convex_planes(Surface& surface);

/// Throws OpenSurfaceError, naming atoms by their index, unless the certificate says the surface is closed.
void require_closed(const Surface& surface);

/// Throws std::logic_error if the tables of borders and faces were released (Surface::sums), so that no mesh is made
/// from empty tables.
void require_borders(const Surface& surface);

/// Computes the reduced surface by `engine` and then the surface, for the balls as given; the certificate may fail.
/// atoms: vdW balls in Å; probe_radius >= 0 in Å. Adds the time of each stage to `clock`. Throws GpuError,
/// CapacityError.
Surface attempt_surface(ReducedSurfaceEngine& engine, std::span<const Ball> atoms, double probe_radius,
                        StageClock& clock, ClipPlanes planes = ClipPlanes::listed);

/// Computes the surface in as many attempts as ties require.
Surface compute_surface(ReducedSurfaceEngine& engine, std::span<const Ball> atoms, double probe_radius,
                        StageClock& clock, ClipPlanes planes = ClipPlanes::listed);

/// Computes the complete surface in double precision on the CPU, on all cores that TBB may use. atoms: vdW balls in Å;
/// probe_radius >= 0 in Å. Throws OpenSurfaceError, CapacityError.
Surface compute_surface_cpu(std::span<const Ball> atoms, double probe_radius);

/// The largest number of attempts: the first with the given radii, the others with grown radii, by 0.016 Å in the last.
/// Growth of more than 1e-4 Å is for probes of 50 Å and more that touch dozens of atoms at once, where rounding is
/// larger in proportion.
inline constexpr int kTieAttempts = 15;

/// Returns the largest growth in an attempt, Å: 0 for attempt 0, then 1e-8 Å, and then three times the previous one.
double tie_growth(int attempt);

/// Returns the radius that the ball with this index has in an attempt.
double grown_radius(double radius, std::size_t index, int attempt);

/// Returns the balls of an attempt. Radii grow by half to all of tie_growth(attempt), by a different amount for each
/// index.
std::vector<Ball> grown_balls(std::span<const Ball> balls, int attempt);

/// Computes a surface in attempts until its certificate holds. Decisions are taken for radii that grow by about 1e-9 Å
/// (decision_weights()), while positions are computed from the given ones. Where many spheres meet in one point, nearly
/// or exactly, a figure of 1e-9 Å that the decisions see may be inside out in the positions; the certificate then
/// refuses it. Radii that truly grow by more than decisions do leave no tie, so decisions and positions describe one
/// figure. Touching still counts as overlapping. compute: balls -> Surface. Returns the first attempt whose certificate
/// holds, with Certificate::grown_by set, else the result of attempt 0.
template <typename Compute>
Surface compute_through_ties(std::span<const Ball> balls, const Compute& compute) {
  Surface surface = compute(balls);
  if (surface.certificate.closed) return surface;
  for (int attempt = 1; attempt < kTieAttempts; ++attempt) {
    surface = {};  // released before the next attempt takes as much memory
    surface = compute(std::span<const Ball>(grown_balls(balls, attempt)));
    if (!surface.certificate.closed) continue;
    surface.certificate.grown_by = tie_growth(attempt);
    surface.certificate.exact_within += tie_growth(attempt);
    return surface;
  }
  surface = {};
  return compute(balls);
}

class EglContext;

/// Makes an engine in this context, which must be current and must outlive the engine. Kernels and buffers are reused
/// from frame to frame. Results equal those of the CPU, arc by arc. Based on Krone, Dachsbacher & Ertl 2010, with
/// circles (contour build-up) in place of their atom triples.
std::unique_ptr<ReducedSurfaceEngine> make_gpu_engine(const EglContext& context);

/// Makes an engine in a context of its own, which it leaves current. Throws GpuError if there is no such device.
std::unique_ptr<ReducedSurfaceEngine> make_gpu_engine(const DeviceChoice& choice);

/// Makes a tracer that leaves circles in doubt to the host. The context of `programs` must be current; `programs` must
/// outlive the tracer.
std::unique_ptr<CuspTracer> make_gpu_cusp_tracer(ProgramCache& programs);

}  // namespace meniscus
