// SPDX-License-Identifier: BSD-3-Clause
// How long the edges of an even mesh are to be, and how near to the surface its triangles, at any place.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "core/mesh/surface_walk.h"

namespace meniscus {

/// How fine an even mesh is.
struct EvenMeshOptions {
  double density = 0.0;  ///< > 0: vertices per Å² of the exact area, to some 10 %, below 0.3 to 25 %; 0: by tolerance
  double tolerance = 0.05;  ///< Å; without a density. No point of the mesh is farther from the surface
  /// Of tolerances that depend on the place (Å at a point, smooth): used instead of `tolerance`, which is their
  /// smallest.
  std::function<double(const glm::dvec3&)> tolerance_at;
};

/// The edge length (Å) of so many vertices per Å²; 0 of none.
double edge_of_density(double density);

class EvenSizes {
 public:
  /// Both have to live as long.
  EvenSizes(const Surface& surface, const EvenMeshOptions& options);

  bool by_density() const { return options_.density > 0.0; }
  /// Å; with a density about that of equilateral triangles.
  double tolerance() const;
  /// Å; without a density.
  double tolerance_at(const glm::dvec3& x) const;
  /// The edge length (Å) wanted at a point of the surface.
  double edge_at(const SurfacePoint& point) const;
  /// The same along creases, where spheres of the probe meet, or balls if it has no size.
  double crease_edge_at(const glm::dvec3& x) const { return edge_at(x, probe()); }

 private:
  double probe() const;
  double edge_at(const glm::dvec3& x, double radius) const;

  const Surface& surface_;
  const EvenMeshOptions& options_;
  double smallest_ball_;  ///< Å: of curvature where the probe has no size
  double edge_of_density_;
};

}  // namespace meniscus
