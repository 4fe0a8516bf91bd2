// SPDX-License-Identifier: BSD-3-Clause
// The components of the reduced surface: the closed sheets on which the probe's centre can move.
//
// The probe's centre moves on arcs, over fixed probes and on the spheres of atoms; what it reaches from one place is a
// component of the reduced surface (Sanner, Olson & Spehner 1996),
// a closed sheet of the solvent-accessible surface. Components of the solvent-excluded surface are another matter:
// probes of two components may be less than two radii apart and cut each other's patches, whereupon two sheets
// become one; and a sheet may part into several where it pinches itself at a spindle. Programs that follow the reduced
// surface, MSMS first of all, number its components, and cut the patches of each by its own probes only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/surface/primitives.h"

namespace meniscus {

class ReducedSurfaceEngine;
class StageClock;

/// Which component each part of a surface belongs to. Outer components come first, then cavities, each by falling area.
struct ReducedComponents {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> of_face;      ///< per Surface::faces
  std::vector<std::uint32_t> of_toroidal;  ///< per Surface::toroidal; empty with a probe of radius 0
  std::vector<std::uint32_t> of_probe;     ///< per Surface::concave; empty likewise
};

/// Needs a closed surface. With a probe of radius 0 these are the components of the surface.
ReducedComponents reduced_components(const Surface& surface);

/// Does a probe of one component cut a patch of another?
bool cut_each_other(const Surface& surface, const ReducedComponents& components);

/// What one component adds up to.
struct ReducedComponentSize {
  double contact = 0.0;     ///< Å² of convex faces
  double toroidal = 0.0;    ///< Å²
  double reentrant = 0.0;   ///< Å² of concave faces
  double accessible = 0.0;  ///< Å² of the solvent-accessible surface
  double volume = 0.0;      ///< Å³, signed: negative for a cavity
  double area() const { return contact + toroidal + reentrant; }
};

/// One for each component. A sheet of the surface counts for the component that its faces are of, so each of them must
/// be of one: true after compute_component_surface(), or where components do not cut each other.
std::vector<ReducedComponentSize> sizes_of(const Surface& surface, const ReducedComponents& components);

/// A surface whose every sheet is of one component, cut by its own probes, and which component that is.
struct ComponentSurface {
  Surface surface;
  ReducedComponents components;
};

/// compute_surface() with the patches of each component cut by its own probes only: the exact surface of each side of
/// the solvent-accessible surface as if the other components were not there. Where no component cuts another it is the
/// surface itself, and costs as much. Look at the certificate; components are found where it holds.
ComponentSurface compute_component_surface(ReducedSurfaceEngine& engine, std::span<const Ball> atoms,
                                           double probe_radius, StageClock& clock);

}  // namespace meniscus
