// SPDX-License-Identifier: BSD-3-Clause
// Projects a point to the surface: walks from face to face while the point is beyond a wall of a face's cell.
#include "core/mesh/surface_walk.h"

#include <numbers>

#include <tbb/parallel_for.h>

#include "core/mesh/mesh_colors.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

/// A point that is less than this (Å) beyond a wall counts as on it: both faces have one tangent plane there.
constexpr double kOnWall = 1e-9;
/// A point that is less than this (Å) beyond a plane of a patch is on it: planes and borders follow two formulas.
constexpr double kOffPatch = 1e-8;
/// The most faces that one walk visits.
constexpr int kLongestWalk = 40;

/// Returns the angle (radian) of x about the axis of an arc's circle, from the arc's start, in the turn around the
/// middle of the arc.
template <typename Arc>
double angle_along(const Arc& arc, const glm::dvec3& x) {
  const glm::dvec3 from_center = x - arc.center;
  const double angle =
      std::atan2(glm::dot(from_center, glm::cross(arc.axis, arc.start)), glm::dot(from_center, arc.start));
  const double turn = 2.0 * std::numbers::pi;
  return angle - turn * std::floor((angle - 0.5 * arc.sweep) / turn + 0.5);
}

}  // namespace

SurfaceWalk::SurfaceWalk(const Surface& surface)
    : surface_(surface), barred_(surface.borders.size(), false), first_(surface.faces.size() + 1, 0) {
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    first_[f + 1] = first_[f];
    for (const Loop& loop : loops_of(surface, surface.faces[f])) first_[f + 1] += loop.half_border_count;
  }
  sides_.resize(first_.back());
  tbb::parallel_for(std::size_t{0}, surface.faces.size(),
                    [&](std::size_t f) { list_sides(static_cast<std::uint32_t>(f)); });
}

void SurfaceWalk::list_sides(std::uint32_t f) {
  const Face& face = surface_.faces[f];
  std::uint32_t place = first_[f];
  for_each_half_border(surface_, face, [&](HalfBorder half) {
    const std::uint32_t b = border_of(half);
    const Border& border = surface_.borders[b];
    Side& side = sides_[place++];
    side.border = b;
    side.beyond = border.face[is_backwards(half) ? 0 : 1];
    if (face.kind != PatchKind::toroidal) {
      // Seen from outside, the part of a sphere on the left of a circle is on the side of the circle's axis.
      const bool along = is_backwards(half) == (face.kind == PatchKind::convex);
      side.normal = along ? border.axis : -border.axis;
      side.offset = glm::dot(side.normal, border.center);
    } else {
      const ToroidalPatch& torus = surface_.toroidal[face.patch];
      const glm::dvec3 middle = arc_point(border, 0.5 * border.sweep);
      if (border.kind == BorderKind::contact) {
        const auto angles = contact_angles(surface_, torus);
        side.offset = tube_angle(torus, middle);
        const bool low = std::abs(side.offset - angles[0]) <= std::abs(side.offset - angles[1]);
        side.wall = low ? Wall::tube_low : Wall::tube_high;
      } else {
        side.wall = std::abs(angle_along(torus, middle)) < std::abs(angle_along(torus, middle) - torus.sweep)
                        ? Wall::start
                        : Wall::end;
      }
    }
  });
}

SurfaceWalk::Projection SurfaceWalk::project_to_sphere(const glm::dvec3& x, std::uint32_t face,
                                                       const glm::dvec3& center, double radius) const {
  const glm::dvec3 out = x - center;
  const double length = glm::length(out);
  Projection found;
  if (!(length > 1e-3 * radius)) {
    found.is_lost = true;
    return found;
  }
  found.foot = center + (radius / length) * out;
  double worst = kOnWall;
  for (std::uint32_t s = first_[face]; s < first_[face + 1]; ++s) {
    const double beyond = glm::dot(sides_[s].normal, found.foot) - sides_[s].offset;
    if (beyond > worst) worst = beyond, found.crossed = &sides_[s];
  }
  return found;
}

SurfaceWalk::Projection SurfaceWalk::project_to_torus(const glm::dvec3& x, std::uint32_t face,
                                                      const ToroidalPatch& torus) const {
  Projection found;
  const double probe = surface_.probe_radius;
  const glm::dvec3 from_center = x - torus.center;
  const double along = glm::dot(from_center, torus.axis);
  const glm::dvec3 across = from_center - along * torus.axis;
  const double away = glm::length(across);
  const glm::dvec3 outward = away > 0.0 ? across / away : torus.start;
  const double inwards = torus.radius - away, length = std::hypot(inwards, along);
  if (!(length > 1e-3 * probe)) {
    found.is_lost = probe > 0.0;
    found.foot = torus.center + torus.radius * outward;
    if (found.is_lost) return found;
  } else {
    found.foot =
        torus.center + (torus.radius - probe * inwards / length) * outward + (probe * along / length) * torus.axis;
  }
  const double tube = std::atan2(along, inwards), angle = torus.free() ? 0.0 : angle_along(torus, x);
  double worst = kOnWall;
  for (std::uint32_t s = first_[face]; s < first_[face + 1]; ++s) {
    const Side& side = sides_[s];
    double beyond = 0.0;
    if (side.wall == Wall::tube_low) beyond = (side.offset - tube) * std::max(probe, length);
    if (side.wall == Wall::tube_high) beyond = (tube - side.offset) * std::max(probe, length);
    if (side.wall == Wall::start) beyond = -angle * away;
    if (side.wall == Wall::end) beyond = (angle - torus.sweep) * away;
    if (beyond > worst) worst = beyond, found.crossed = &side;
  }
  if (found.crossed || !surface_.spindle(torus)) return found;
  // Past its axis the tube of a spindle is not part of the surface; on the other side is the other piece.
  const bool second = torus.piece(face - torus.first_face) == 1;
  found.is_lost = (tube > 0.0) != second || torus.radius * length < probe * inwards;
  return found;
}

SurfaceWalk::Projection SurfaceWalk::project(const glm::dvec3& x, std::uint32_t f) const {
  const Face& face = surface_.faces[f];
  if (face.kind == PatchKind::toroidal) return project_to_torus(x, f, surface_.toroidal[face.patch]);
  if (face.kind == PatchKind::concave)
    return project_to_sphere(x, f, surface_.concave[face.patch].center, surface_.probe_radius);
  const Ball& atom = surface_.atoms[surface_.convex[face.patch].atom];
  return project_to_sphere(x, f, atom.center, atom.radius);
}

/// True if a foot lies on the patch of a face. The borders of the face are not all cuts of its patch: beyond other cuts
/// there are other pieces, or nothing.
bool SurfaceWalk::on_patch(const glm::dvec3& foot, std::uint32_t f) const {
  const Face& face = surface_.faces[f];
  if (face.kind == PatchKind::toroidal) return true;
  std::uint32_t first = 0, count = 0;
  if (face.kind == PatchKind::convex) {
    first = surface_.convex[face.patch].first_plane;
    count = surface_.convex[face.patch].plane_count;
  } else {
    first = surface_.concave[face.patch].first_plane;
    count = surface_.concave[face.patch].plane_count();
  }
  return std::all_of(surface_.planes.begin() + first, surface_.planes.begin() + first + count,
                     [&](const Plane& plane) { return glm::dot(plane.normal, foot) <= plane.offset + kOffPatch; });
}

std::optional<SurfacePoint> SurfaceWalk::below(const glm::dvec3& x, std::uint32_t face) const {
  std::uint32_t before = kNone;
  for (int step = 0; step < kLongestWalk; ++step) {
    const Projection projection = project(x, face);
    if (projection.is_lost) return std::nullopt;
    if (!projection.crossed)
      return on_patch(projection.foot, face) ? std::optional(SurfacePoint{projection.foot, face}) : std::nullopt;
    const Side& side = *projection.crossed;
    if (barred_[side.border]) return std::nullopt;
    if (side.beyond == before) {  // x is over a shallow cusp, where both spheres point to each other
      const auto at = on_border(x, side.border);
      if (!at) return std::nullopt;
      return SurfacePoint{*at, face};
    }
    before = face;
    face = side.beyond;
  }
  return std::nullopt;
}

std::optional<glm::dvec3> SurfaceWalk::on_border(const glm::dvec3& x, std::uint32_t b) const {
  const Border& border = surface_.borders[b];
  const glm::dvec3 from_center = x - border.center;
  const glm::dvec3 across = from_center - glm::dot(from_center, border.axis) * border.axis;
  const double away = glm::length(across);
  if (!(away > 0.0)) return std::nullopt;
  if (border.vertex[0] != kNone) {
    const double angle = angle_along(border, x);
    if (!(angle >= 0.0 && angle <= border.sweep)) return std::nullopt;
  }
  return border.center + (border.radius / away) * across;
}

std::optional<SurfacePoint> SurfaceWalk::on_near_cusp(const glm::dvec3& x, std::uint32_t face) const {
  std::optional<SurfacePoint> nearest;
  const auto visit_cusps_of = [&](std::uint32_t f) {
    for (std::uint32_t s = first_[f]; s < first_[f + 1]; ++s) {
      const Border& border = surface_.borders[sides_[s].border];
      if (border.kind != BorderKind::cusp) continue;
      const double angle =
          border.vertex[0] == kNone ? angle_along(border, x) : std::clamp(angle_along(border, x), 0.0, border.sweep);
      const glm::dvec3 at = arc_point(border, angle);
      if (!nearest || glm::distance(x, at) < glm::distance(x, nearest->position)) nearest = SurfacePoint{at, f};
    }
  };
  visit_cusps_of(face);
  for (std::uint32_t s = first_[face]; s < first_[face + 1]; ++s)
    if (!barred_[sides_[s].border]) visit_cusps_of(sides_[s].beyond);
  return nearest;
}

glm::dvec3 SurfaceWalk::normal(const SurfacePoint& point) const {
  const Face& face = surface_.faces[point.face];
  if (face.kind == PatchKind::convex)
    return glm::normalize(point.position - surface_.atoms[surface_.convex[face.patch].atom].center);
  if (face.kind == PatchKind::concave) return glm::normalize(surface_.concave[face.patch].center - point.position);
  const ToroidalPatch& torus = surface_.toroidal[face.patch];
  const glm::dvec3 from_center = point.position - torus.center;
  const glm::dvec3 across = from_center - glm::dot(from_center, torus.axis) * torus.axis;
  const double away = glm::length(across);
  const glm::dvec3 outward = away > 1e-12 ? across / away : arc_direction(torus, 0.5 * torus.sweep);
  if (surface_.probe_radius == 0.0) return outward;  // two balls of one size meet here
  return glm::normalize(torus.center + torus.radius * outward - point.position);
}

std::uint32_t SurfaceWalk::nearest_atom(const SurfacePoint& point) const {
  const Face& face = surface_.faces[point.face];
  if (face.kind == PatchKind::convex) return surface_.convex[face.patch].atom;
  if (face.kind == PatchKind::toroidal) {
    const ToroidalPatch& torus = surface_.toroidal[face.patch];
    const auto angles = contact_angles(surface_, torus);
    return torus.atom[tube_angle(torus, point.position) < 0.5 * (angles[0] + angles[1]) ? 0 : 1];
  }
  const ConcavePatch& patch = surface_.concave[face.patch];
  std::uint32_t nearest = kNone;
  double best = 0.0;
  for (std::uint32_t i = 0; i < patch.contact_count; ++i) {
    const std::uint32_t atom = surface_.contacts[patch.first_contact + i];
    const double score =
        glm::dot(glm::normalize(surface_.atoms[atom].center - patch.center), point.position - patch.center);
    if (nearest == kNone || score > best) nearest = atom, best = score;
  }
  return nearest;
}

double SurfaceWalk::radius(std::uint32_t f) const {
  const Face& face = surface_.faces[f];
  return face.kind == PatchKind::convex ? surface_.atoms[surface_.convex[face.patch].atom].radius
                                        : surface_.probe_radius;
}

}  // namespace meniscus
