// SPDX-License-Identifier: BSD-3-Clause
// Singularities: which fixed probes cut which concave patches, and the cusp curves where they do.
//
// Only fixed probes cut concave patches, and only where a patch leaves its simplex through the base (theorem 1.3), so
// both partners of a cusp curve are lower over their atoms than their radius. All probes on one spindle circle pass
// through the same two points of its axis; there the order around the axis decides, not arithmetic.
#pragma once

#include "core/surface/cusp_tracer.h"
#include "core/surface/fixed_probes.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct ReducedComponents;

/// An exposed arc of the circle in which two fixed probes intersect, counter-clockwise about the axis probe[0] ->
/// probe[1]; vertex kNone twice: a whole circle.
struct CuspArc {
  std::array<std::uint32_t, 2> probe{};               ///< probe[0] < probe[1]
  std::array<std::uint32_t, 2> vertex{kNone, kNone};  ///< begin and end: axis cusp or index into CuspParts::triple
  std::array<bool, 2> on_axis{};                      ///< vertex is an axis cusp: toroidal patch * 2 + side
  glm::dvec3 center{0.0};                             ///< Å
  glm::dvec3 axis{0.0};                               ///< unit vector
  double radius = 0.0;                                ///< Å
  glm::dvec3 start{0.0};                              ///< unit vector, perpendicular to axis
  double sweep = 0.0;                                 ///< radians
};

/// The parts of a surface that follow from fixed probes that reach into each other.
struct CuspParts {
  std::vector<CuspArc> arcs;
  std::vector<glm::dvec3> triple;          ///< points where three probes meet on the surface
  std::vector<std::uint32_t> first_cut;    ///< per probe, into cuts; one past the last closes the list
  std::vector<std::uint32_t> cuts;         ///< probes whose ball reaches into the probe's spherical polygon, ascending
  std::vector<std::uint32_t> open_probes;  ///< probes at triples that not exactly three arcs agree on; empty if closed
  std::vector<std::uint32_t> first_on_circle;  ///< the result of first_on_circle(); empty with a probe of radius 0
};

/// Returns the axis cusp near atom[side] on the spindle circle of a toroidal patch: at most p from the circle's centre.
glm::dvec3 axis_cusp(const ToroidalPatch& patch, double probe_radius, int side);

/// Maps each toroidal patch to the first patch on its circle, by which axis cusps are named. With `within`, only
/// patches of one component share a circle.
std::vector<std::uint32_t> first_on_circle(std::span<const ToroidalPatch> toroidal,
                                           const ReducedComponents* within = nullptr);

/// Finds cuts and cusp curves. With `within`, only probes of one component of the reduced surface cut each other.
CuspParts find_cusps(std::span<const Ball> atoms, double probe_radius, const FixedProbes& probes,
                     std::span<const ToroidalPatch> toroidal, CuspTracer& tracer,
                     const ReducedComponents* within = nullptr);

}  // namespace meniscus
