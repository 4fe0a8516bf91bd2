// SPDX-License-Identifier: BSD-3-Clause
// Outlines convex and concave faces, which lie on spheres, in the plane where they are meshed.
#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include <glm/geometric.hpp>

#include "core/mesh/face_mesh.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

struct Sphere {
  glm::dvec3 center;
  double radius;
  std::span<const Plane> planes;
};

Sphere sphere_of(const Surface& surface, const Face& face) {
  if (face.kind == PatchKind::convex) {
    const ConvexPatch& patch = surface.convex[face.patch];
    const Ball& ball = surface.atoms[patch.atom];
    return {ball.center, ball.radius, {surface.planes.data() + patch.first_plane, patch.plane_count}};
  }
  const ConcavePatch& patch = surface.concave[face.patch];
  return {patch.center, surface.probe_radius, {surface.planes.data() + patch.first_plane, patch.plane_count()}};
}

/// Returns the direction outside the patch that is farthest from the rim: the middle of a cap that a plane cuts off, or
/// the direction opposite to the rim.
glm::dvec3 projection_pole(const Sphere& sphere, const std::vector<FacePoint>& rim) {
  std::vector<glm::dvec3> candidates;
  for (const Plane& plane : sphere.planes) candidates.push_back(plane.normal);
  glm::dvec3 middle(0.0);
  for (const FacePoint& p : rim) middle += p.position - sphere.center;
  if (glm::length(middle) > 1e-9) candidates.push_back(-glm::normalize(middle));
  glm::dvec3 best = candidates.front();
  double best_cosine = 2.0;
  for (const glm::dvec3& u : candidates) {
    const glm::dvec3 x = sphere.center + sphere.radius * u;
    const bool outside = std::any_of(sphere.planes.begin(), sphere.planes.end(),
                                     [&](const Plane& plane) { return glm::dot(plane.normal, x) > plane.offset; });
    if (!outside) continue;
    double cosine = -1.0;
    for (const FacePoint& p : rim) cosine = std::max(cosine, glm::dot(u, p.position - sphere.center) / sphere.radius);
    if (cosine < best_cosine) {
      best_cosine = cosine;
      best = u;
    }
  }
  return best;
}

/// Returns the lattice directions inside all planes, at least `margin` radian from their circles.
std::vector<glm::dvec3> directions_inside(const Sphere& sphere, const SphereLattice& lattice, double margin) {
  std::vector<double> limit;
  for (const Plane& plane : sphere.planes) {
    const double cosine = (plane.offset - glm::dot(plane.normal, sphere.center)) / sphere.radius;
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) + margin;
    limit.push_back(angle >= 3.14159 ? -2.0 : std::cos(angle));
  }
  std::vector<glm::dvec3> inside;
  for (const glm::dvec3& u : lattice.directions) {
    bool in = true;
    for (std::size_t i = 0; in && i < limit.size(); ++i) in = glm::dot(sphere.planes[i].normal, u) <= limit[i];
    if (in) inside.push_back(u);
  }
  return inside;
}

}  // namespace

FaceOutline sphere_outline(const Surface& surface, const Face& face, const BorderSamples& samples,
                           const SphereLattice& lattice, double edge) {
  FaceOutline outline;
  std::map<BorderPoint, int> known;
  auto rim_point = [&](std::uint32_t border, std::uint32_t k) {
    const BorderPoint name = samples.point(border, k);
    const auto [at, fresh] = known.try_emplace(name, static_cast<int>(outline.points.size()));
    if (fresh) {
      outline.points.push_back({samples.position(name), {}});
      outline.names.push_back(name);
    }
    return at->second;
  };
  for (const Loop& loop : loops_of(surface, face)) {
    const std::size_t before = outline.edges.size();
    for (const HalfBorder half : half_borders_of(surface, loop)) {
      const std::uint32_t border = border_of(half), n = samples.segment_count(border);
      for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t from = is_backwards(half) ? n - k : k, to = is_backwards(half) ? n - k - 1 : k + 1;
        outline.edges.push_back({rim_point(border, from), rim_point(border, to)});
        outline.segments.push_back({border, std::min(from, to)});
      }
    }
    outline.loop_count += outline.edges.size() > before;
  }
  const Sphere sphere = sphere_of(surface, face);
  auto domain =
      std::make_unique<SphereDomain>(sphere.center, sphere.radius, sphere.planes,
                                     projection_pole(sphere, outline.points), face.kind == PatchKind::concave);
  for (const glm::dvec3& u : directions_inside(sphere, lattice, 0.55 * edge / sphere.radius)) {
    outline.interior.push_back(domain->at(u));
  }
  outline.domain = std::move(domain);
  return outline;
}

FaceMesh whole_sphere(const Surface& surface, const Face& face, const SphereLattice& lattice) {
  const Sphere sphere = sphere_of(surface, face);
  const bool inwards = face.kind == PatchKind::concave;
  auto domain =
      std::make_unique<SphereDomain>(sphere.center, sphere.radius, sphere.planes, glm::dvec3(0, 0, 1), inwards);
  FaceMesh mesh;
  for (const glm::dvec3& u : lattice.directions) mesh.points.push_back(domain->at(u));
  mesh.triangles = lattice.triangles;
  if (inwards) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  mesh.domain = std::move(domain);
  return mesh;
}

}  // namespace meniscus
