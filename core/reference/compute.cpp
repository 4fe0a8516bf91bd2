// SPDX-License-Identifier: BSD-3-Clause
// The surface on the CPU from end to end.
#include "core/reference/exhaustive.h"
#include "core/surface/surface.h"

namespace meniscus {

Surface compute_surface_cpu(std::span<const Ball> atoms, double probe_radius) {
  Surface surface = assemble_surface(atoms, probe_radius, enumerate_reduced_surface(atoms, probe_radius));
  require_closed(surface);
  return surface;
}

}  // namespace meniscus
