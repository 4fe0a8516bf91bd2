// SPDX-License-Identifier: BSD-3-Clause
// Draws uniform points on spheres and tori, and applies the clips of primitives.h.
#include "tests/support/patch_samples.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <glm/geometric.hpp>

#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  // Points are drawn one by one: compilers order arguments differently, and every compiler must see the same points.
  const double z = normal(random), y = normal(random), x = normal(random);
  return glm::normalize(glm::dvec3(x, y, z));
}

struct Sphere {
  glm::dvec3 center;
  double radius;
  std::span<const Plane> planes;
};

Sphere sphere_of(const Surface& s, PatchKind kind, std::uint32_t patch) {
  if (kind == PatchKind::convex) {
    const ConvexPatch& c = s.convex[patch];
    return {s.atoms[c.atom].center, s.atoms[c.atom].radius, {s.planes.data() + c.first_plane, c.plane_count}};
  }
  const ConcavePatch& c = s.concave[patch];
  return {c.center, s.probe_radius, {s.planes.data() + c.first_plane, c.plane_count()}};
}

// Returns the least of plane.offset - dot(normal, x): positive inside.
double depth(std::span<const Plane> planes, const glm::dvec3& x) {
  double least = 1e300;
  for (const Plane& plane : planes) least = std::min(least, plane.offset - glm::dot(plane.normal, x));
  return least;
}

// Returns the signed distance of a point of the torus at direction e, from the axis and height to the nearest clip.
double torus_depth(const Surface& s, const ToroidalPatch& t, const glm::dvec3& e, double psi) {
  const double p = s.probe_radius, from_axis = t.radius - p * std::cos(psi), height = p * std::sin(psi);
  const auto contact_height = [&](std::uint32_t atom) {
    return glm::dot(t.axis, s.atoms[atom].center - t.center) * p / (s.atoms[atom].radius + p);
  };
  double least =
      std::min({p * std::cos(psi), from_axis, height - contact_height(t.atom[0]), contact_height(t.atom[1]) - height});
  if (!t.has_piece[0]) least = std::min(least, height);
  if (!t.has_piece[1]) least = std::min(least, -height);
  if (t.free()) return least;
  double turn = std::atan2(glm::dot(t.axis, glm::cross(t.start, e)), glm::dot(t.start, e));
  if (turn < 0) turn += 2 * kPi;
  const double past_end = t.sweep - turn, past_start = turn - 2 * kPi;
  const double along = past_end > 0 ? std::min(turn, past_end) : std::max(past_end, past_start);
  return std::min(least, along * std::abs(from_axis));
}

PatchSample sample_torus(const Surface& s, std::uint32_t patch, bool siblings, std::mt19937& random) {
  const ToroidalPatch& t = s.toroidal[patch];
  const double p = s.probe_radius;
  std::uniform_real_distribution<double> angle(-kPi, kPi), unit(0, 1);
  // Draws by area: the ring at tube angle psi (0 towards the axis) has radius |T - p cos psi|.
  double psi = 0;
  do psi = angle(random);
  while (unit(random) * (t.radius + p) > std::abs(t.radius - p * std::cos(psi)));
  const double theta = angle(random);
  const glm::dvec3 e = std::cos(theta) * t.start + std::sin(theta) * glm::cross(t.axis, t.start);
  double depth = torus_depth(s, t, e, psi);
  // Patches are sorted by their atoms: those on one circle are together.
  if (siblings) {
    std::uint32_t other = patch;
    while (other > 0 && s.toroidal[other - 1].atom == t.atom) --other;
    for (; other < s.toroidal.size() && s.toroidal[other].atom == t.atom; ++other)
      depth = std::max(depth, torus_depth(s, s.toroidal[other], e, psi));
  }
  return {t.center + (t.radius - p * std::cos(psi)) * e + p * std::sin(psi) * t.axis, depth > 0, std::abs(depth)};
}

}  // namespace

std::size_t patch_count(const Surface& surface, PatchKind kind) {
  if (kind == PatchKind::convex) return surface.convex.size();
  return kind == PatchKind::toroidal ? surface.toroidal.size() : surface.concave.size();
}

double whole_area(const Surface& surface, PatchKind kind, std::uint32_t patch) {
  const double p = surface.probe_radius;
  if (kind != PatchKind::toroidal) {
    const double r = sphere_of(surface, kind, patch).radius;
    return 4 * kPi * r * r;
  }
  const double t = surface.toroidal[patch].radius;
  if (t >= p) return 4 * kPi * kPi * p * t;
  // 2 pi p times the integral of |t - p cos psi| over psi: both sides of the axis.
  const double tip = std::acos(t / p);
  return 4 * kPi * p * (t * (kPi - 2 * tip) + 2 * p * std::sin(tip));
}

double face_area(const Surface& surface, PatchKind kind, std::uint32_t patch) {
  const auto sum = [&](const auto& p) {
    double area = 0;
    for (std::uint32_t f = p.first_face; f < p.first_face + p.face_count; ++f) area += surface.faces[f].area;
    return area;
  };
  if (kind == PatchKind::convex) return sum(surface.convex[patch]);
  return kind == PatchKind::toroidal ? sum(surface.toroidal[patch]) : sum(surface.concave[patch]);
}

bool inside_planes(const Surface& surface, PatchKind kind, std::uint32_t patch, const glm::dvec3& point) {
  return depth(sphere_of(surface, kind, patch).planes, point) > 0;
}

PatchSample sample_circle(const Surface& surface, std::uint32_t patch, std::mt19937& random) {
  return sample_torus(surface, patch, true, random);
}

PatchSample sample_patch(const Surface& surface, PatchKind kind, std::uint32_t patch, std::mt19937& random) {
  if (kind == PatchKind::toroidal) return sample_torus(surface, patch, false, random);
  const Sphere sphere = sphere_of(surface, kind, patch);
  PatchSample sample;
  sample.point = sphere.center + sphere.radius * random_direction(random);
  const double least = depth(sphere.planes, sample.point);
  sample.inside = least > 0;
  sample.clearance = std::abs(least);
  return sample;
}

}  // namespace meniscus::testing
