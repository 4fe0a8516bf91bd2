// SPDX-License-Identifier: BSD-3-Clause
// The second half of the pipeline as a list of its stages: place, cut, bound, trim, measure, certify.
#include <algorithm>
#include <mutex>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/surface/boundary.h"
#include "core/surface/certificate.h"
#include "core/surface/cusps.h"
#include "core/surface/fixed_probes.h"
#include "core/surface/measure.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/surface.h"
#include "core/surface/trim.h"
#include "core/base/stage_clock.h"

namespace meniscus {
Surface assemble_surface(std::span<const Ball> atoms, double probe_radius, const ReducedSurface& rs, StageClock* clock,
                         CuspTracer* tracer, ClipPlanes planes, const ReducedComponents* cut_within) {
  StageClock unused;
  StageClock& stages = clock ? *clock : unused;
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
    const auto cpu_tracer = tracer ? nullptr : make_cpu_cusp_tracer();
    cusps =
        find_cusps(atoms, probe_radius, rolling.probes, surface.toroidal, tracer ? *tracer : *cpu_tracer, cut_within);
  }
  {
    const auto stage = stages.stage("primitives");
    list_concave_patches(surface, rolling.probes, cusps);
    build_boundary(surface, rolling.probes, cusps, rs);
    if (planes == ClipPlanes::listed) trim_convex_patches(surface, rs);
  }
  const auto stage = stages.stage("area and volume");
  // Where patches have no planes the few that the checks ask for are found for them alone.
  std::optional<ConvexTrimmer> trimmer;
  std::once_flag asked;
  const auto find_planes = [&](std::uint32_t c, PlaneChoice choice) {
    std::call_once(asked, [&] { trimmer.emplace(surface, rs); });
    return trimmer->planes_of(c, choice);
  };
  const ConvexPlanes convex = planes == ClipPlanes::left_out ? ConvexPlanes(find_planes) : listed_planes(surface);
  certify(surface, measure_surface(surface, convex), convex);
  return surface;
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

SurfaceCounts Surface::counts() const {
  SurfaceCounts n;
  // A part of a surface may hold several patches of one atom or probe; they stand next to each other.
  for (std::size_t c = 0; c < convex.size(); ++c) n.convex += c == 0 || convex[c].atom != convex[c - 1].atom;
  n.toroidal = toroidal.size();
  for (std::size_t c = 0; c < concave.size(); ++c) {
    if (c > 0 && concave[c].center == concave[c - 1].center) continue;
    ++n.fixed_probes;
    n.concave += concave[c].face_count > 0;
  }
  for (const ToroidalPatch& patch : toroidal) {
    n.free_edges += patch.free();
    n.spindle += spindle(patch);
  }
  n.arcs = n.toroidal - n.free_edges;
  return n;
}

}  // namespace meniscus
