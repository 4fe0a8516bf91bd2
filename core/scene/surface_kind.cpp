// SPDX-License-Identifier: BSD-3-Clause
// Makes accessible surfaces of excluded ones: the probe's centre moves on balls enlarged by its radius (Lee and
// Richards 1971).
#include "core/scene/surface_kind.h"

#include "core/base/error.h"
#include "core/base/message.h"

namespace meniscus {

double growth_of(SurfaceKind kind, double probe_radius) { return kind == SurfaceKind::sas ? probe_radius : 0.0; }

double rolling_probe(SurfaceKind kind, double probe_radius) { return kind == SurfaceKind::ses ? probe_radius : 0.0; }

std::vector<Ball> grown(std::span<const Ball> balls, double growth) {
  std::vector<Ball> larger(balls.begin(), balls.end());
  for (Ball& ball : larger) ball.radius += growth;
  return larger;
}

void require_probe_of_kind(const SurfaceRequest& request) {
  if (request.kind == SurfaceKind::vdw && request.probe_named)
    throw RequestError(message("@probe@: the van der Waals surface has no probe; leave @probe@ or @surface vdw@ out"));
}

}  // namespace meniscus
