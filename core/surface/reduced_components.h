// SPDX-License-Identifier: BSD-3-Clause
// The components of the reduced surface: the closed sheets on which the probe's centre can move.
//
// The probe's centre moves on arcs, over fixed probes and on the spheres of atoms. The region that it reaches from one
// place is a component of the reduced surface (Sanner, Olson & Spehner 1996), a closed sheet of the solvent-accessible
// surface. Components of the solvent-excluded surface differ from them: probes of two components may be less than two
// radii apart and cut each other's patches, which joins two sheets; and a sheet may split where it pinches itself at a
// spindle. Programs that follow the reduced surface, such as MSMS, number its components, and cut the patches of each
// only by its own probes.
#pragma once

#include "core/surface/primitives.h"

namespace meniscus {

class ReducedSurfaceEngine;
class StageClock;

/// The component of each part of a surface. Outer components come first, then cavities, each by falling area.
struct ReducedComponents {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> of_face;      ///< per Surface::faces
  std::vector<std::uint32_t> of_toroidal;  ///< per Surface::toroidal; empty with a probe of radius 0
  std::vector<std::uint32_t> of_probe;     ///< per Surface::concave; empty with a probe of radius 0
};

/// Finds the components of a closed surface. With a probe of radius 0 they are the components of the surface.
ReducedComponents reduced_components(const Surface& surface);

/// True if a probe of one component cuts a patch of another.
bool cut_each_other(const Surface& surface, const ReducedComponents& components);

/// The areas and the volume of one component.
struct ReducedComponentSize {
  double contact = 0.0;     ///< Å² of convex faces
  double toroidal = 0.0;    ///< Å²
  double reentrant = 0.0;   ///< Å² of concave faces
  double accessible = 0.0;  ///< Å² of the solvent-accessible surface
  double volume = 0.0;      ///< Å³, signed: negative for a cavity
  double area() const { return contact + toroidal + reentrant; }
};

/// Returns the size of each component. A sheet of the surface counts for the component of its faces, so each sheet must
/// belong to one component: true after compute_component_surface(), or where components do not cut each other.
std::vector<ReducedComponentSize> sizes_of(const Surface& surface, const ReducedComponents& components);

/// A surface in which every sheet belongs to one component and is cut only by that component's probes.
struct ComponentSurface {
  Surface surface;
  ReducedComponents components;
};

/// Computes the surface like compute_surface(), but cuts the patches of each component only by its own probes: the
/// exact surface of each sheet of the solvent-accessible surface as if the other components did not exist. Where no
/// component cuts another it is the surface itself, and costs as much. Look at the certificate; components are found
/// only where it holds.
ComponentSurface compute_component_surface(ReducedSurfaceEngine& engine, std::span<const Ball> atoms,
                                           double probe_radius, StageClock& clock);

}  // namespace meniscus
