// SPDX-License-Identifier: BSD-3-Clause
// Makes the closed mesh that an even one begins with, at finer tolerances where one does not close.
#include "core/mesh/base_mesh.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "core/mesh/tessellate.h"

namespace meniscus {
namespace {

/// Patch-aligned meshes are a scaffold: their tolerance follows that of the result between these (Å).
constexpr double kFinest = 1e-4, kCoarsest = 0.4;
constexpr int kTries = 4;
/// Arcs (radian) that are one edge where contact faces become points.
constexpr double kWideAngle = 1.6;

TriangleMesh patches(const Surface& surface, double tolerance) {
  tolerance = std::clamp(tolerance, kFinest, kCoarsest);
  for (int n = 1;; ++n, tolerance *= 0.25) {
    try {
      return tessellate(surface, {tolerance, false});
    } catch (const OpenSurfaceError&) {
      if (n == kTries) throw;
    }
  }
}

}  // namespace

BaseMesh base_mesh(const Surface& surface, const SurfaceWalk& walk, Beginning beginning, double tolerance) {
  if (beginning == Beginning::contracted) return contracted_mesh(surface, walk, coarse_mesh(surface, walk, kWideAngle));
  BaseMesh base;
  base.mesh = beginning == Beginning::coarse ? coarse_mesh(surface, walk) : patches(surface, tolerance);
  base.vertex_face = vertex_faces(base.mesh);
  return base;
}

}  // namespace meniscus
