// SPDX-License-Identifier: BSD-3-Clause
// Closed forms on the sphere: Gauss-Bonnet areas, boundary moments, and a crossing test for points and loops.
#include "core/surface/spherical.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace meniscus {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 rotated(const SphereArc& arc, double angle) {
  const glm::dvec3 along = arc.axis * arc.height;
  const glm::dvec3 e = arc.from - along;
  return along + std::cos(angle) * e + std::sin(angle) * glm::cross(arc.axis, e);
}

// Unit tangent of the walk at a point of the arc.
glm::dvec3 tangent(const SphereArc& arc, const glm::dvec3& point) {
  const glm::dvec3 t = glm::cross(arc.axis, point);
  const double length = glm::length(t);
  return length > 0 ? t * ((arc.sweep < 0 ? -1.0 : 1.0) / length) : t;
}

}  // namespace

SphereArc sphere_arc(const Border& border, bool backwards, const glm::dvec3& center, double radius) {
  SphereArc arc;
  arc.axis = border.axis;
  arc.height = glm::dot(border.center - center, border.axis) / radius;
  const double ratio = border.radius / radius;
  const glm::dvec3 along = arc.axis * arc.height;
  const glm::dvec3 side = glm::cross(border.axis, border.start);
  const glm::dvec3 first = along + ratio * border.start;
  const glm::dvec3 last = along + ratio * (std::cos(border.sweep) * border.start + std::sin(border.sweep) * side);
  arc.from = backwards ? last : first;
  arc.to = backwards ? first : last;
  arc.sweep = backwards ? -border.sweep : border.sweep;
  arc.whole = border.vertex[0] == kNone;
  return arc;
}

double area_left_of(std::span<const SphereArc> loop) {
  // Gauss-Bonnet on the unit sphere: area = 2 pi - integral of geodesic curvature - exterior angles. The curvature of
  // a circle at height h, walked counter-clockwise, integrates to h times the angle.
  double turning = 0;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const SphereArc& arc = loop[n];
    turning += arc.height * arc.sweep;
    if (arc.whole) continue;
    const SphereArc& next = loop[n + 1 == loop.size() ? 0 : n + 1];
    const glm::dvec3 in = tangent(arc, arc.to), out = tangent(next, next.from);
    double exterior = std::atan2(glm::dot(arc.to, glm::cross(in, out)), glm::dot(in, out));
    if (exterior < -0.5 * kPi) exterior += 2 * kPi;  // patches are convex at their corners: no interior angle over pi
    turning += exterior;
  }
  double area = 2 * kPi - turning;
  area -= 4 * kPi * std::floor(area / (4 * kPi));
  return area;
}

glm::dvec3 moment_left_of(std::span<const SphereArc> loop) {
  glm::dvec3 sum(0.0);
  for (const SphereArc& arc : loop)
    sum += arc.height * glm::cross(arc.axis, arc.to - arc.from) +
           arc.axis * ((1 - arc.height * arc.height) * arc.sweep);
  return 0.5 * sum;
}

glm::dvec3 middle_of(const SphereArc& arc) { return rotated(arc, 0.5 * arc.sweep); }

bool lies_left_of(const glm::dvec3& point, std::span<const SphereArc> loop) {
  // Walk along a great circle from a point of the loop to the given point and count crossings. Of a few starts take
  // the one where the path leaves the loop most steeply: point and loop often share a circle.
  const SphereArc* leaving = nullptr;
  glm::dvec3 start(0.0), normal(0.0);
  double steepest = 0;
  for (const SphereArc& arc : loop)
    for (const double part : {0.5, 0.2, 0.8}) {
      const glm::dvec3 candidate = rotated(arc, part * arc.sweep);
      const glm::dvec3 across = glm::cross(candidate, point);
      const double length = glm::length(across);
      if (length < 1e-12) continue;
      const double steepness = std::abs(glm::dot(across / length, tangent(arc, candidate))) * std::min(1.0, 1e3 * length);
      if (steepness <= steepest) continue;
      steepest = steepness;
      leaving = &arc;
      start = candidate;
      normal = across / length;
    }
  if (!leaving) return false;
  const glm::dvec3 side = glm::cross(normal, start);  // direction of departure
  const double total = std::atan2(glm::dot(side, point), glm::dot(start, point));
  bool left = glm::dot(side, glm::cross(start, tangent(*leaving, start))) > 0;
  for (const SphereArc& arc : loop) {
    // Points of both circles: on the path's plane and at the arc's height.
    const glm::dvec3 flat = arc.axis - normal * glm::dot(arc.axis, normal);
    const double flat2 = glm::dot(flat, flat);
    const double reach = arc.height * arc.height / flat2;
    if (!(reach < 1)) continue;
    const glm::dvec3 middle = flat * (arc.height / flat2);
    const glm::dvec3 offset = glm::cross(normal, flat) * std::sqrt((1 - reach) / flat2);
    for (const double sign : {-1.0, 1.0}) {
      const glm::dvec3 u = middle + sign * offset;
      double along = std::atan2(glm::dot(side, u), glm::dot(start, u));
      if (along < 0) along += 2 * kPi;
      if (&arc == leaving && (along < 1e-9 || along > 2 * kPi - 1e-9)) continue;  // the start itself
      if (along >= total) continue;
      const glm::dvec3 e = arc.from - arc.axis * arc.height, f = u - arc.axis * arc.height;
      double angle = std::atan2(glm::dot(arc.axis, glm::cross(e, f)), glm::dot(e, f));
      if (arc.sweep < 0) angle = -angle;
      if (angle < 0) angle += 2 * kPi;
      if (arc.whole || angle < std::abs(arc.sweep)) left = !left;
    }
  }
  return left;
}

}  // namespace meniscus
