// SPDX-License-Identifier: BSD-3-Clause
// Computes the wanted edge length and the tolerance at any place of a surface.
#include "core/mesh/remesh_tuning.h"

namespace meniscus {
namespace {

double smallest_radius(const Surface& surface) {
  double radius = std::numeric_limits<double>::infinity();
  for (const Ball& atom : surface.atoms) radius = std::min(radius, atom.radius);
  return radius;
}

}  // namespace

double edge_of_density(double density) {
  return density > 0.0 ? std::sqrt(RemeshTuning::vertices_per_square / density) : 0.0;
}

EvenSizes::EvenSizes(const Surface& surface, const EvenMeshOptions& options)
    : surface_(surface),
      options_(options),
      smallest_ball_(smallest_radius(surface)),
      edge_of_density_(edge_of_density(options.density)) {
  for (const Component& component : surface.components)
    longest_edge_.push_back(std::min(edge_of_density_, std::sqrt(RemeshTuning::vertices_per_square * component.area /
                                                                 RemeshTuning::fewest_vertices)));
}

double EvenSizes::probe() const { return surface_.probe_radius > 0.0 ? surface_.probe_radius : smallest_ball_; }

double EvenSizes::tolerance() const {
  const double edge = edge_of_density_;
  return edge > 0.0 ? edge * edge / (6.0 * probe()) : options_.tolerance;
}

double EvenSizes::tolerance_at(const glm::dvec3& x) const {
  return options_.tolerance_at ? std::max(options_.tolerance_at(x), options_.tolerance) : options_.tolerance;
}

double EvenSizes::edge_at(const SurfacePoint& point) const {
  const Face& face = surface_.faces[point.face];
  if (by_density()) return longest_edge_[face.component];
  const bool convex = face.kind == PatchKind::convex;
  return edge_at(point.position, convex ? surface_.atoms[surface_.convex[face.patch].atom].radius : probe());
}

double EvenSizes::edge_at(const glm::dvec3& x, double radius) const {
  return edge_of_density_ > 0.0 ? edge_of_density_
                                : std::sqrt(6.0 * RemeshTuning::share_of_tolerance * tolerance_at(x) * radius);
}

}  // namespace meniscus
