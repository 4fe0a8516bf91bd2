// SPDX-License-Identifier: BSD-3-Clause
// The object behind the handle of a surface.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/queries/distance.h"
#include "core/scene/surface_request.h"
#include "core/surface/atom_areas.h"
#include "core/surface/primitives.h"
#include "exporters/bindings/c/c_calls.h"

namespace meniscus::c_api {

/// A finished surface, and what has been asked of it.
struct FinishedSurface {
  Surface surface;
  SurfaceKind kind = SurfaceKind::ses;
  double probe_radius = 0.0;  ///< as asked
  int threads = 0;            ///< of what is found out later; 0: all
  std::string device;

  /// Found out by the first who asks, from any thread.
  const AtomAreas& areas() const;
  const SurfaceDistance& distance() const;

 private:
  mutable std::mutex mutex_;
  mutable std::optional<AtomAreas> areas_;
  mutable std::optional<SurfaceDistance> distance_;
};

}  // namespace meniscus::c_api

struct meniscus_surface : meniscus::c_api::Counted {
  std::shared_ptr<const meniscus::c_api::FinishedSurface> finished;  ///< with its meshes
};
