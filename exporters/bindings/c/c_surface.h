// SPDX-License-Identifier: BSD-3-Clause
// The object behind the handle of a surface.
#pragma once

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

}  // namespace meniscus::c_api

/// The object behind the handle of a surface.
struct meniscus_surface : meniscus::c_api::Counted {
  std::shared_ptr<const meniscus::c_api::FinishedSurface> finished;  ///< shared with the meshes of the surface
};
