// SPDX-License-Identifier: BSD-3-Clause
// Computes the curvature at a point of a patch, and decides whether a point lies in the solvent.
#include "core/queries/surface_point.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include <glm/geometric.hpp>

#include "core/math/double_geometry.h"
#include "core/surface/primitives.h"

namespace meniscus {
namespace {

Curvature of_sphere(double curvature) { return {curvature, curvature * curvature}; }

Curvature of_torus(const ToroidalPatch& t, double probe_radius, const glm::dvec3& point) {
  const glm::dvec3 from_center = point - t.center;
  const double from_axis = glm::length(from_center - glm::dot(from_center, t.axis) * t.axis);
  // R - p cos t is the distance from the axis; on a spindle's inner part, past the axis, there is no surface.
  const double cosine = (t.radius - from_axis) / probe_radius;
  const double along_tube = -1.0 / probe_radius, around_axis = cosine / std::max(from_axis, kCurvatureCore);
  return {0.5 * (along_tube + around_axis), along_tube * around_axis};
}

}  // namespace

Curvature curvature(const Surface& surface, std::uint32_t face, const glm::dvec3& point) {
  const Face& f = surface.faces[face];
  switch (f.kind) {
    case PatchKind::convex:
      return of_sphere(1.0 / surface.atoms[surface.convex[f.patch].atom].radius);
    case PatchKind::toroidal:
      return of_torus(surface.toroidal[f.patch], surface.probe_radius, point);
    default:
      return of_sphere(-1.0 / surface.probe_radius);
  }
}

namespace {

constexpr double kDoubt = 1e-6;  // Å from the surface within which a point may count as not in the solvent
// The most balls with triples that are tried: a million, in a tenth of a second.
constexpr std::size_t kMostBalls = 200;

/// The balls around a point that any accessible place near it must avoid, relative to the point.
class Surroundings {
 public:
  Surroundings(std::span<const Ball> atoms, double probe_radius, const glm::dvec3& point) : reach_(probe_radius) {
    for (const Ball& atom : atoms) {
      const Ball ball{atom.center - point, atom.radius + probe_radius};
      const double distance = glm::length(ball.center);
      covered_ = covered_ || distance < ball.radius;
      if (distance < ball.radius + probe_radius) balls_.push_back(ball);
    }
  }

  /// True if some accessible place is nearer to the point than the probe's radius.
  bool has_accessible_place() const {
    if (!covered_) return true;
    const bool few = balls_.size() <= kMostBalls;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      const double distance = glm::length(balls_[i].center);
      if (distance > 0.0 && is_accessible(balls_[i].center * (1.0 - balls_[i].radius / distance), {i})) return true;
    }
    for (std::size_t i = 0; i < balls_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (has_accessible_on_two(i, j, few)) return true;
    return false;
  }

 private:
  // True if a place, relative to the point and on the spheres of `touching`, is near enough and in no other ball.
  bool is_accessible(const glm::dvec3& place, std::initializer_list<std::size_t> touching) const {
    if (glm::length(place) > reach_ - kDoubt) return false;
    for (std::size_t n = 0; n < balls_.size(); ++n) {
      const glm::dvec3 d = place - balls_[n].center;
      if (glm::dot(d, d) < balls_[n].radius * balls_[n].radius &&
          std::find(touching.begin(), touching.end(), n) == touching.end())
        return false;
    }
    return true;
  }

  /// True if the nearest place on the circle of two spheres is accessible or, with `and_on_three`, one on a third
  /// sphere.
  bool has_accessible_on_two(std::size_t i, std::size_t j, bool and_on_three) const {
    const Ball &a = balls_[i], &b = balls_[j];
    const geometry::Circle circle =
        geometry::circle_of_two_spheres(b.center - a.center, a.radius * a.radius, b.radius * b.radius);
    if (!(circle.radius_squared > 0.0)) return false;
    const glm::dvec3 center = a.center + circle.axis * circle.height;
    const glm::dvec3 across = -center + circle.axis * glm::dot(center, circle.axis);
    const double offset = glm::length(across);
    if (offset > 0.0 && is_accessible(center + across * (circle.radius / offset), {i, j})) return true;
    for (std::size_t k = 0; and_on_three && k < j; ++k)
      for (const double side : {-1.0, 1.0}) {
        const Ball& c = balls_[k];
        double h2 = 0.0;
        const glm::dvec3 place =
            a.center + geometry::probe_of_three(b.center - a.center, c.center - a.center, a.radius * a.radius,
                                                b.radius * b.radius, c.radius * c.radius, side, h2);
        if (h2 >= 0.0 && is_accessible(place, {i, j, k})) return true;
      }
    return false;
  }

  double reach_;
  bool covered_ = false;  // true if a SAS ball covers the point
  std::vector<Ball> balls_;
};

}  // namespace

bool in_solvent(std::span<const Ball> atoms, double probe_radius, const glm::dvec3& point) {
  return Surroundings(atoms, probe_radius, point).has_accessible_place();
}

}  // namespace meniscus
