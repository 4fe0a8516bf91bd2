// SPDX-License-Identifier: BSD-3-Clause
// Brute-force ray casting in double precision.
#include "tests/image/ray_caster_twin.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/render/ray_geometry.h"

namespace meniscus::testing {
namespace {

constexpr double kSlack = 1e-9;

/// A torus patch in its own frame.
struct TorusFrame {
  glm::dvec3 x, y, z;
  double height[2], extended[2];

  TorusFrame(const Surface& surface, const ToroidalPatch& patch)
      : x(patch.start), y(glm::cross(patch.axis, patch.start)), z(patch.axis) {
    for (int i = 0; i < 2; ++i) {
      const Ball& ball = surface.atoms[patch.atom[i]];
      height[i] = glm::dot(ball.center - patch.center, patch.axis);
      extended[i] = ball.radius + surface.probe_radius;
    }
  }
  glm::dvec3 to_local(const glm::dvec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
};

}  // namespace

RayCasterTwin::RayCasterTwin(const Surface& surface, const Coloring& coloring)
    : surface_(surface), coloring_(coloring) {
  for (std::uint32_t i = 0; i < surface.convex.size(); ++i) {
    const Ball& ball = surface.atoms[surface.convex[i].atom];
    candidates_.push_back({ball.center, ball.radius, PatchKind::convex, i});
  }
  const double p = surface.probe_radius;
  for (std::uint32_t i = 0; i < surface.toroidal.size(); ++i)
    candidates_.push_back({surface.toroidal[i].center, surface.toroidal[i].radius + p, PatchKind::toroidal, i});
  for (std::uint32_t i = 0; i < surface.concave.size(); ++i)
    if (surface.concave[i].face_count > 0) candidates_.push_back({surface.concave[i].center, p, PatchKind::concave, i});
}

std::optional<TwinHit> RayCasterTwin::trace(const Ray& ray) const {
  double nearest = std::numeric_limits<double>::max();
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates_) {
    const glm::dvec3 v = candidate.center - ray.origin;
    const double along = glm::dot(v, ray.direction);
    const glm::dvec3 across = v - ray.direction * along;
    if (glm::dot(across, across) > candidate.radius * candidate.radius) continue;
    const double t = hit(candidate, ray, nearest);
    if (t < nearest) {
      nearest = t;
      best = &candidate;
    }
  }
  if (!best) return std::nullopt;
  return describe(*best, ray, nearest);
}

double RayCasterTwin::hit(const Candidate& candidate, const Ray& ray, double nearest) const {
  if (candidate.kind == PatchKind::toroidal) return hit_toroidal(candidate, ray, nearest);
  if (candidate.kind == PatchKind::convex) {
    const ConvexPatch& patch = surface_.convex[candidate.patch];
    return hit_sphere(candidate, patch.first_plane, patch.plane_count, ray, nearest);
  }
  const ConcavePatch& patch = surface_.concave[candidate.patch];
  return hit_sphere(candidate, patch.first_plane, patch.plane_count(), ray, nearest);
}

bool RayCasterTwin::shows(const Candidate& candidate, const Ray& ray, double t) const {
  return coloring_.shows(describe(candidate, ray, t).atom);
}

double RayCasterTwin::hit_sphere(const Candidate& candidate, std::uint32_t first_plane, std::uint32_t plane_count,
                                 const Ray& ray, double nearest) const {
  const geometry::SphereHits hits =
      geometry::ray_sphere(ray.origin - candidate.center, ray.direction, candidate.radius);
  if (!hits.found) return nearest;
  for (const double t : {hits.near_t, hits.far_t}) {
    if (t <= 0.0 || t >= nearest) continue;
    bool inside = true;
    for (std::uint32_t i = first_plane; i < first_plane + plane_count && inside; ++i)
      inside = geometry::in_half_space(ray.origin + ray.direction * t, surface_.planes[i].normal,
                                       surface_.planes[i].offset, kSlack);
    if (inside && shows(candidate, ray, t)) return t;
  }
  return nearest;
}

double RayCasterTwin::hit_toroidal(const Candidate& candidate, const Ray& ray, double nearest) const {
  const ToroidalPatch& patch = surface_.toroidal[candidate.patch];
  const double p = surface_.probe_radius;
  const TorusFrame frame(surface_, patch);
  const double shift = -glm::dot(ray.origin - patch.center, ray.direction);
  const glm::dvec3 o = frame.to_local(ray.origin + ray.direction * shift - patch.center);
  const glm::dvec3 d = frame.to_local(ray.direction);
  const double reach = patch.radius + p;
  const geometry::TorusHits hits = geometry::ray_torus(o, d, patch.radius, p, -reach, reach, 1e-14);
  const int range = patch.free()                      ? geometry::kWholeTurn
                    : patch.sweep <= std::numbers::pi ? geometry::kUpToHalfTurn
                                                      : geometry::kOverHalfTurn;
  for (int i = 0; i < hits.count; ++i) {
    const double t = hits.t[i] + shift;
    if (t <= 0.0 || t >= nearest) continue;
    const double z = o.z + d.z * hits.t[i];
    if ((z < 0.0 && !patch.has_piece[0]) || (z > 0.0 && !patch.has_piece[1])) continue;
    if (geometry::in_toroidal_patch(o + d * hits.t[i], patch.radius, frame.height[0] * p / frame.extended[0],
                                    frame.height[1] * p / frame.extended[1], std::cos(patch.sweep),
                                    std::sin(patch.sweep), range, kSlack) &&
        shows(candidate, ray, t))
      return t;
  }
  return nearest;
}

TwinHit RayCasterTwin::describe(const Candidate& candidate, const Ray& ray, double t) const {
  const glm::dvec3 x = ray.origin + ray.direction * t;
  TwinHit result{t, glm::normalize(x - candidate.center), candidate.kind, candidate.patch, 0};
  if (candidate.kind == PatchKind::convex) {
    result.atom = surface_.convex[candidate.patch].atom;
    return result;
  }
  // The colour comes from the touched atom whose direction from the probe is nearest to the point's (coloring.h).
  glm::dvec3 probe = candidate.center;
  std::vector<std::uint32_t> touched;
  if (candidate.kind == PatchKind::concave) {
    const ConcavePatch& patch = surface_.concave[candidate.patch];
    touched.assign(surface_.contacts.begin() + patch.first_contact,
                   surface_.contacts.begin() + patch.first_contact + patch.contact_count);
  } else {
    const ToroidalPatch& patch = surface_.toroidal[candidate.patch];
    touched.assign(patch.atom.begin(), patch.atom.end());
    const glm::dvec3 v = x - patch.center;
    probe = patch.center + glm::normalize(v - patch.axis * glm::dot(v, patch.axis)) * patch.radius;
  }
  result.normal = glm::normalize(probe - x);
  double best = -2.0;
  for (const std::uint32_t atom : touched) {
    const double nearness = glm::dot(glm::normalize(surface_.atoms[atom].center - probe), glm::normalize(x - probe));
    if (nearness > best) {
      best = nearness;
      result.atom = atom;
    }
  }
  return result;
}

}  // namespace meniscus::testing
