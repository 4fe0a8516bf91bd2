// SPDX-License-Identifier: BSD-3-Clause
// Samples a volume map at points of each patch, weighted by the areas of its faces.
#include "core/scene/map_coverage.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/math/box.h"
#include "core/math/spiral.h"

namespace meniscus {
namespace {

/// The number of sampled points of a patch, and the number of them beyond the map.
struct Tally {
  std::size_t points = 0, beyond = 0;
};

/// The measurement of one copy of an object.
class Coverage {
 public:
  Coverage(const VolumePaint& map, const SurfaceObject& object, const RigidMotion& motion)
      : map_(map), object_(object), surface_(object.surface), motion_(motion) {}

  /// True if the whole surface lies in the map, because a closing of balls lies in their convex hull, and a map's grid
  /// is convex.
  bool holds_all() const {
    Box box;
    for (const Ball& ball : surface_.atoms) {
      const double reach = ball.radius + std::abs(map_.offset);
      const glm::dvec3 center = motion_(ball.center);
      box.include(center - reach);
      box.include(center + reach);
    }
    for (int corner = 0; corner < 8; ++corner)
      if (!holds({corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                  corner & 4 ? box.high.z : box.low.z}))
        return false;
    return true;
  }

  /// The area with the map's colours, and the part of it where the map has no values, Å².
  struct Areas {
    double shown = 0.0, beyond = 0.0;
  };
  Areas areas() const {
    Areas sum;
    const auto add = [&](const Tally& tally, double area) {
      if (tally.points == 0) return;
      sum.shown += area;
      sum.beyond += area * static_cast<double>(tally.beyond) / static_cast<double>(tally.points);
    };
    for (const ConvexPatch& patch : surface_.convex)
      if (shows(patch.atom)) add(on_sphere(patch), area_of(patch));
    for (const ToroidalPatch& patch : surface_.toroidal)
      if (shows(patch.atom[0]) || shows(patch.atom[1])) add(on_borders(patch), area_of(patch));
    for (const ConcavePatch& patch : surface_.concave) {
      const auto first = surface_.contacts.begin() + patch.first_contact;
      if (std::any_of(first, first + patch.contact_count, [&](std::uint32_t a) { return shows(a); }))
        add(on_borders(patch), area_of(patch));
    }
    return sum;
  }

 private:
  bool shows(std::uint32_t a) const { return object_.coloring.by_volume(a) && object_.coloring.shows(a); }
  bool holds(const glm::dvec3& point) const { return !std::isnan(map_.grid.sample(point)); }

  void count(const glm::dvec3& point, const glm::dvec3& normal, Tally& tally) const {
    ++tally.points;
    tally.beyond += std::isnan(map_.value(motion_(point), motion_.rotation * normal));
  }

  double area_of(const auto& patch) const {
    double area = 0.0;
    for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f)
      area += surface_.faces[f].area;
    return area;
  }

  /// Counts points on the sphere of a patch; for a patch too small to contain any, points on its borders.
  Tally on_sphere(const ConvexPatch& patch) const {
    constexpr std::size_t kPoints = 100;
    const Ball& ball = surface_.atoms[patch.atom];
    const std::span planes(surface_.planes.data() + patch.first_plane, patch.plane_count);
    Tally tally;
    for (std::size_t n = 0; n < kPoints; ++n) {
      const glm::dvec3 normal = spiral_direction(n, kPoints), point = ball.center + ball.radius * normal;
      if (std::ranges::all_of(planes, [&](const Plane& p) { return glm::dot(p.normal, point) <= p.offset; }))
        count(point, normal, tally);
    }
    return tally.points > 0 ? tally : on_borders(patch);
  }

  Tally on_borders(const auto& patch) const {
    constexpr double kTurn = std::numbers::pi / 8.0;  // radians between points of a border
    Tally tally;
    for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f)
      for (std::uint32_t l = 0; l < surface_.faces[f].loop_count; ++l) {
        const Loop& loop = surface_.loops[surface_.faces[f].first_loop + l];
        for (std::uint32_t h = 0; h < loop.half_border_count; ++h) {
          const Border& border = surface_.borders[surface_.half_borders[loop.first_half_border + h] / 2];
          const int points = 1 + static_cast<int>(border.sweep / kTurn);
          for (int n = 0; n < points; ++n) {
            const double turn = border.sweep * (n + 0.5) / points;
            const glm::dvec3 point =
                border.center + border.radius * (std::cos(turn) * border.start +
                                                 std::sin(turn) * glm::cross(border.axis, border.start));
            count(point, normal_of(patch, point), tally);
          }
        }
      }
    return tally;
  }

  glm::dvec3 normal_of(const ConvexPatch& patch, const glm::dvec3& point) const {
    return glm::normalize(point - surface_.atoms[patch.atom].center);
  }
  glm::dvec3 normal_of(const ConcavePatch& patch, const glm::dvec3& point) const {
    return glm::normalize(patch.center - point);
  }
  glm::dvec3 normal_of(const ToroidalPatch& patch, const glm::dvec3& point) const {
    const glm::dvec3 from = point - patch.center;
    const glm::dvec3 probe =
        patch.center + patch.radius * glm::normalize(from - patch.axis * glm::dot(patch.axis, from));
    return glm::normalize(probe - point);
  }

  const VolumePaint& map_;
  const SurfaceObject& object_;
  const Surface& surface_;
  const RigidMotion& motion_;
};

}  // namespace

double share_beyond(const VolumePaint& map, std::span<const SurfaceObject> objects) {
  const auto holds = [&](const SurfaceObject& object) {
    return std::ranges::all_of(object.copies,
                               [&](const RigidMotion& copy) { return Coverage(map, object, copy).holds_all(); });
  };
  if (std::ranges::all_of(objects, holds)) return 0.0;
  double shown = 0.0, beyond = 0.0;
  for (const SurfaceObject& object : objects)
    for (const RigidMotion& copy : object.copies) {
      const Coverage::Areas areas = Coverage(map, object, copy).areas();
      shown += areas.shown;
      beyond += areas.beyond;
    }
  return shown > 0.0 ? beyond / shown : 0.0;
}

}  // namespace meniscus
