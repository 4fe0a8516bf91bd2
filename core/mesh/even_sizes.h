// SPDX-License-Identifier: BSD-3-Clause
// The edge lengths and the distance from the surface that an even mesh should have.
#pragma once

#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/surface_walk.h"

namespace meniscus {

/// The fineness of an even mesh.
struct EvenMeshOptions {
  /// Above 0: vertices per Å² of the exact area. The result has this density to within some 10 %, below 0.3 to within
  /// 25 %, and at least about 12 vertices per component. 0: the tolerance decides.
  double density = 0.0;
  double tolerance = 0.05;  ///< Å, used without a density: no point of the mesh is farther from the surface
  /// The tolerance (Å) at a point, a smooth function. If set, it is used instead of `tolerance`, which is its smallest
  /// value.
  std::function<double(const glm::dvec3&)> tolerance_at;
};

/// Returns the edge length (Å) of a mesh with this many vertices per Å²; 0 for a density of 0.
double edge_of_density(double density);

/// The edge lengths and distances that an even mesh should have at each place of a surface.
class EvenSizes {
 public:
  /// Both arguments must outlive this object.
  EvenSizes(const Surface& surface, const EvenMeshOptions& options);

  bool by_density() const { return options_.density > 0.0; }
  /// Returns the tolerance (Å); with a density, about the distance of equilateral triangles of that density from the
  /// surface.
  double tolerance() const;
  /// Returns the tolerance (Å) at a point; only for options without a density.
  double tolerance_at(const glm::dvec3& x) const;
  /// Returns the edge length (Å) wanted at a point of the surface.
  double edge_at(const SurfacePoint& point) const;
  /// Returns the edge length (Å) wanted along creases, where spheres of the probe meet, or balls if the probe radius is
  /// 0.
  double crease_edge_at(const glm::dvec3& x) const { return edge_at(x, probe()); }

 private:
  double probe() const;
  double edge_at(const glm::dvec3& x, double radius) const;

  const Surface& surface_;
  const EvenMeshOptions& options_;
  double smallest_ball_;  ///< smallest radius (Å) of a ball: the radius of curvature if the probe radius is 0
  double edge_of_density_;
  /// Per component, Å, with a density: short enough for the fewest vertices that a component needs.
  std::vector<double> longest_edge_;
};

}  // namespace meniscus
