// SPDX-License-Identifier: BSD-3-Clause
// Turns the hit of a pixel's ray into a point in double precision, and finds the component of a patch at a point.
#include "core/render/hit_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "core/surface/walks.h"

namespace meniscus {

HitPoint hit_point(const PictureFrame& frame, glm::ivec2 pixel, float t) {
  const Ray ray = pixel_ray(frame.camera, frame.size, glm::dvec2(pixel) + 0.5);
  // The kernel counts from the plane through the pivot.
  const double z = t + frame.eye_distance / glm::dot(ray.direction, frame.basis.forward);
  return {z, ray.origin + ray.direction * z};
}

namespace {

double squared_length(const glm::dvec3& v) { return glm::dot(v, v); }

/// First face and face count of a patch.
std::pair<std::uint32_t, std::uint32_t> faces_of(const Surface& surface, PatchKind kind, std::uint32_t patch) {
  switch (kind) {
    case PatchKind::convex:
      return {surface.convex[patch].first_face, surface.convex[patch].face_count};
    case PatchKind::toroidal:
      return {surface.toroidal[patch].first_face, surface.toroidal[patch].face_count};
    case PatchKind::concave:
      return {surface.concave[patch].first_face, surface.concave[patch].face_count};
  }
  return {0, 0};
}

}  // namespace

double squared_distance(const Border& border, const glm::dvec3& point) {
  const glm::dvec3 v = point - border.center, side = glm::cross(border.axis, border.start);
  const double x = glm::dot(v, border.start), y = glm::dot(v, side), z = glm::dot(v, border.axis);
  double angle = std::atan2(y, x);
  if (angle < 0.0) angle += 2.0 * std::numbers::pi;
  if (angle <= border.sweep) {
    const double across = std::hypot(x, y) - border.radius;
    return across * across + z * z;
  }
  return std::min(squared_length(v - border.radius * border.start),
                  squared_length(v - border.radius * arc_direction(border, border.sweep)));
}

std::uint32_t ComponentLookup::at(PatchKind kind, std::uint32_t patch, const glm::dvec3& point) const {
  const auto [first, count] = faces_of(surface_, kind, patch);
  if (count == 0) return kNone;
  const auto begin = surface_.faces.begin() + first, end = begin + count;
  if (std::all_of(begin, end, [&](const Face& face) { return face.component == begin->component; }))
    return begin->component;
  std::uint32_t component = kNone;
  double nearest = std::numeric_limits<double>::max();
  for (auto face = begin; face != end; ++face) {
    const double distance = squared_distance(*face, point);
    if (distance < nearest) {
      nearest = distance;
      component = face->component;
    }
  }
  return component;
}

double ComponentLookup::squared_distance(const Face& face, const glm::dvec3& point) const {
  double nearest = std::numeric_limits<double>::max();
  for_each_border(surface_, face, [&](const Border& border) {
    nearest = std::min(nearest, meniscus::squared_distance(border, point));
  });
  return nearest;
}

}  // namespace meniscus
