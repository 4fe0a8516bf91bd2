// SPDX-License-Identifier: BSD-3-Clause
// The object behind the handle of a surface, and the positions, radii and colours of atoms that callers pass.
#pragma once

#include "core/color/coloring.h"
#include "core/queries/distance.h"
#include "core/scene/surface_computer.h"
#include "core/surface/measure.h"
#include "core/surface/primitives.h"
#include "exporters/bindings/c/c_calls.h"

namespace meniscus::c_api {

/// A computed surface, with results that are computed when they are first needed.
struct FinishedSurface {
  /// The numbers, balls, borders and faces. The clip planes of convex patches may be missing: see whole().
  mutable Surface surface;
  SurfaceKind kind = SurfaceKind::ses;
  double probe_radius = 0.0;  ///< Å; 0 for vdw
  int threads = 0;            ///< for later computations; 0: all
  std::string device;

  /// The first call computes the result. Any thread may call these functions.
  const Surface& whole() const;  ///< with all clip planes, for pictures, meshes and tables of patches
  const AtomAreas& areas() const;
  const SurfaceDistance& distance() const;

 private:
  mutable std::mutex mutex_;
  mutable std::optional<AtomAreas> areas_;
  mutable std::optional<SurfaceDistance> distance_;
};

/// Returns the atoms of a caller. Refuses invalid numbers; the message has the atom and the value.
std::vector<Ball> read_atoms(const meniscus_atoms* atoms);

/// The sRGB colour of surfaces and meshes for which the caller gives no colour.
inline constexpr glm::vec3 kPlainColor(0.75f, 0.82f, 0.9f);

/// Returns the colours of atoms: of_atoms has three channels per atom; if it is NULL, all atoms have `color`. Refuses
/// channels outside of [0, 1] with MENISCUS_INPUT.
Coloring coloring_of(const glm::vec3& color, const float* of_atoms, std::size_t atoms);

}  // namespace meniscus::c_api

/// The object behind the handle of a surface.
struct meniscus_surface : meniscus::c_api::Counted {
  std::shared_ptr<const meniscus::c_api::FinishedSurface> finished;  ///< shared with the meshes of the surface
};
