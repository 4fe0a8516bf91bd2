// SPDX-License-Identifier: BSD-3-Clause
// Runs the stages from a reduced surface to the finished surface, and repeats them with grown radii to resolve ties.
#include "core/surface/compute_surface.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/boundary.h"
#include "core/surface/certificate.h"
#include "core/surface/cusps.h"
#include "core/surface/fixed_probes.h"
#include "core/surface/measure.h"
#include "core/surface/trim.h"

namespace meniscus {

double tie_growth(int attempt) { return attempt == 0 ? 0.0 : 1e-8 * std::pow(3.0, attempt - 1); }

double grown_radius(double radius, std::size_t index, int attempt) {
  if (attempt == 0) return radius;
  return radius + 0.5 * tie_growth(attempt) * (1 + scattered(index + 0x10001u * static_cast<std::size_t>(attempt)));
}

std::vector<Ball> grown_balls(std::span<const Ball> balls, int attempt) {
  std::vector<Ball> grown(balls.begin(), balls.end());
  for (std::size_t n = 0; n < grown.size(); ++n) grown[n].radius = grown_radius(grown[n].radius, n, attempt);
  return grown;
}

Surface build_surface(std::span<const Ball> atoms, double probe_radius, const ReducedSurface& rs, StageClock& stages,
                      CuspTracer& tracer, ClipPlanes planes, const ReducedComponents* cut_within) {
  Surface surface;
  surface.probe_radius = probe_radius;
  surface.atoms.assign(atoms.begin(), atoms.end());

  RollingParts rolling;
  {
    const auto stage = stages.stage("probes and tori");
    rolling = place_rolling_parts(atoms, probe_radius, rs);
    surface.toroidal = std::move(rolling.toroidal);
    surface.certificate.open_atoms = std::move(rolling.open_atoms);
    surface.certificate.exact_within = std::max(rs.exact_within, rolling.exact_within);
    surface.certificate.open_atoms.insert(surface.certificate.open_atoms.end(), rs.lost_atoms.begin(),
                                          rs.lost_atoms.end());
    if (!surface.certificate.open_atoms.empty()) return surface;
  }
  CuspParts cusps;
  {
    const auto stage = stages.stage("singularities");
    cusps = find_cusps(atoms, probe_radius, rolling.probes, surface.toroidal, tracer, cut_within);
  }
  const auto stage = stages.stage("primitives");
  list_concave_patches(surface, rolling.probes, cusps);
  build_boundary(surface, rolling.probes, cusps, rs);
  if (planes == ClipPlanes::listed) trim_convex_patches(surface, rs);
  return surface;
}

std::unique_ptr<ConvexPlanes> planes_for(ClipPlanes planes, const Surface& surface, const ReducedSurface& rs) {
  if (planes == ClipPlanes::listed) return std::make_unique<ListedPlanes>(surface);
  return std::make_unique<PlanesOnDemand>(surface, rs);
}

Surface assemble_surface(std::span<const Ball> atoms, double probe_radius, const ReducedSurface& rs, StageClock* clock,
                         CuspTracer* tracer, ClipPlanes planes, const ReducedComponents* cut_within) {
  StageClock unused;
  StageClock& stages = clock ? *clock : unused;
  const auto cpu_tracer = tracer ? nullptr : make_cpu_cusp_tracer();
  Surface surface = build_surface(atoms, probe_radius, rs, stages, tracer ? *tracer : *cpu_tracer, planes, cut_within);
  if (surface.faces.empty() && !surface.certificate.open_atoms.empty()) return surface;
  const auto stage = stages.stage("area and volume");
  const std::unique_ptr<ConvexPlanes> convex = planes_for(planes, surface, rs);
  certify(surface, measure_surface(surface, *convex), *convex);
  return surface;
}

void list_convex_planes(Surface& surface) {
  if (const auto reduced = std::exchange(surface.reduced, nullptr)) trim_convex_patches(surface, *reduced);
}

void require_closed(const Surface& surface) {
  if (surface.certificate.closed) return;
  const auto& open = surface.certificate.open_atoms;
  std::string atoms;
  for (std::size_t n = 0; n < open.size() && n < 8; ++n) atoms += (n ? ", " : "") + std::to_string(open[n] + 1);
  if (open.size() > 8) atoms += ", ...";
  throw OpenSurfaceError("the surface is not closed at " + std::to_string(open.size()) + " atoms (used atom number " +
                         atoms + "); nothing was written; please report this structure");
}

void require_borders(const Surface& surface) {
  if (surface.sums) throw std::logic_error("the surface was computed without its borders (SurfaceRequest::bordered)");
}

SurfaceCounts& SurfaceCounts::operator+=(const SurfaceCounts& more) {
  for (const auto count :
       {&SurfaceCounts::convex, &SurfaceCounts::toroidal, &SurfaceCounts::concave, &SurfaceCounts::free_edges,
        &SurfaceCounts::spindle, &SurfaceCounts::fixed_probes, &SurfaceCounts::arcs})
    this->*count += more.*count;
  return *this;
}

SurfaceCounts Surface::counts() const {
  if (sums) return sums->counts;
  return counts_of(*this, [](std::uint32_t) { return true; });
}

SurfaceCounts counts_of(const Surface& s, const std::function<bool(std::uint32_t)>& is_counted) {
  SurfaceCounts n;
  // In a part of a surface, one atom or probe may have several patches; they are adjacent.
  for (std::size_t c = 0; c < s.convex.size(); ++c)
    n.convex += (c == 0 || s.convex[c].atom != s.convex[c - 1].atom) && is_counted(s.convex[c].atom);
  for (std::size_t c = 0; c < s.concave.size(); ++c) {
    if (c > 0 && s.concave[c].center == s.concave[c - 1].center) continue;
    if (!is_counted(first_atom(s, s.concave[c]))) continue;
    ++n.fixed_probes;
    n.concave += s.concave[c].face_count > 0;
  }
  for (const ToroidalPatch& patch : s.toroidal) {
    if (!is_counted(patch.atom[0])) continue;
    ++n.toroidal;
    n.free_edges += patch.free();
    n.spindle += s.spindle(patch);
  }
  n.arcs = n.toroidal - n.free_edges;
  return n;
}

Surface attempt_surface(ReducedSurfaceEngine& engine, std::span<const Ball> atoms, double probe_radius,
                        StageClock& clock, ClipPlanes planes) {
  ReducedSurface rs = engine.reduce(atoms, probe_radius, clock);
  Surface surface = assemble_surface(atoms, probe_radius, rs, &clock, &engine.cusp_tracer(), planes);
  if (planes == ClipPlanes::deferred) surface.reduced = std::make_shared<const ReducedSurface>(std::move(rs));
  return surface;
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

namespace {

class CpuEngine final : public ReducedSurfaceEngine {
 public:
  ReducedSurface reduce(std::span<const Ball> atoms, double probe_radius, StageClock& clock) override {
    const auto stage = clock.stage("reduced surface");
    stats_ = {};
    return enumerate_reduced_surface(atoms, probe_radius, &stats_);
  }

  CuspTracer& cusp_tracer() override { return *cusp_tracer_; }
  const CircleStats& stats() const override { return stats_; }

  std::string device() const override {
    const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return fmt::format("cpu ({} {})", threads, threads == 1 ? "thread" : "threads");
  }

 private:
  std::unique_ptr<CuspTracer> cusp_tracer_ = make_cpu_cusp_tracer();
  CircleStats stats_;
};

}  // namespace

std::unique_ptr<ReducedSurfaceEngine> make_cpu_engine() { return std::make_unique<CpuEngine>(); }

}  // namespace meniscus
