// SPDX-License-Identifier: BSD-3-Clause
// Writes patches as spheres and tori cut out by planes, and computes their exact boxes.
#include "exporters/povray/patch_objects.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/surface/walks.h"

namespace meniscus::povray {
namespace {

// The margin of boxes in Å, which is more than the rounding of any written number.
constexpr double kBoxMargin = 1e-5;

// Returns the half-space of points whose direction from `probe` is nearer to the contact direction `near` than to
// `far`. The directions have unit length.
Plane nearer_to(const glm::dvec3& near, const glm::dvec3& far, const glm::dvec3& probe) {
  const glm::dvec3 normal = glm::normalize(far - near);
  return {normal, glm::dot(normal, probe)};
}

/// Returns the least and the greatest height of a box along the unit vector `normal`.
std::pair<double, double> heights(const Box& box, const glm::dvec3& normal) {
  const double middle = glm::dot(normal, 0.5 * (box.low + box.high));
  const double half = glm::dot(glm::abs(normal), 0.5 * (box.high - box.low));
  return {middle - half, middle + half};
}

}  // namespace

Box PatchObjects::extent(const ColoredPiece& piece) const {
  if (piece.kind == PatchKind::toroidal) return toroidal_extent(surface_, surface_.toroidal[piece.patch]);
  if (piece.kind == PatchKind::concave) return concave_extent(surface_, surface_.concave[piece.patch]);
  const Ball& atom = surface_.atoms[surface_.convex[piece.patch].atom];
  return {atom.center - atom.radius, atom.center + atom.radius};
}

bool PatchObjects::is_cut_away(const ColoredPiece& piece) const {
  if (clip_.empty()) return false;
  const Box box = extent(piece);
  return std::ranges::any_of(
      clip_, [&](const ClipPlane& cut) { return heights(box, cut.normal).first > cut.offset + kBoxMargin; });
}

void PatchObjects::cuts(SceneText& out, const ColoredPiece& piece) const {
  if (clip_.empty()) return;
  const Box box = extent(piece);
  for (const ClipPlane& cut : clip_)
    if (heights(box, cut.normal).second > cut.offset - kBoxMargin)
      plane(out, {cut.normal, cut.offset}, 0.5 * (box.low + box.high));
}

void PatchObjects::append(SceneText& out, const ColoredPiece& piece) const {
  SceneText cut_by;
  cuts(cut_by, piece);
  switch (piece.kind) {
    case PatchKind::convex:
      convex(out, surface_.convex[piece.patch], cut_by.text());
      break;
    case PatchKind::toroidal:
      toroidal(out, surface_.toroidal[piece.patch], piece.part, cut_by.text());
      break;
    case PatchKind::concave:
      concave(out, surface_.concave[piece.patch], piece.part, cut_by.text());
      break;
  }
  out.literal("\n");
}

void PatchObjects::plane(SceneText& out, const Plane& p, const glm::dvec3& anchor) const {
  out.plane({p.normal, p.offset - glm::dot(p.normal, origin_)}, anchor - origin_);
}

void PatchObjects::box(SceneText& out, const glm::dvec3& low, const glm::dvec3& high) const {
  out.literal("box{").point(low - origin_ - kBoxMargin).literal(",").point(high - origin_ + kBoxMargin).literal("}");
}

void PatchObjects::convex(SceneText& out, const ConvexPatch& patch, std::string_view cuts) const {
  const Ball& atom = surface_.atoms[patch.atom];
  out.literal("sphere{").point(atom.center - origin_).literal(",").length(atom.radius);
  if (patch.plane_count > 0 || !cuts.empty()) {
    out.literal(" clipped_by{");
    for (std::uint32_t n = 0; n < patch.plane_count; ++n)
      plane(out, surface_.planes[patch.first_plane + n], atom.center);
    out.literal(cuts).literal("}");
  }
  out.literal("}");
}

void PatchObjects::toroidal(SceneText& out, const ToroidalPatch& patch, std::uint32_t part,
                            std::string_view cuts) const {
  const double p = surface_.probe_radius;
  out.literal("torus{").length(patch.radius).literal(",").length(p).literal(" matrix<");
  // The local y axis is the axis of the torus. The matrix precedes clipped_by, so the clips stay in scene coordinates.
  for (const glm::dvec3& row : {patch.start, patch.axis, glm::cross(patch.start, patch.axis)})
    out.ratio(row.x).literal(",").ratio(row.y).literal(",").ratio(row.z).literal(",");
  const glm::dvec3 center = patch.center - origin_;
  out.length(center.x).literal(",").length(center.y).literal(",").length(center.z).literal("> clipped_by{");
  visibility_sphere(out, patch);
  wedge(out, patch);
  if (surface_.spindle(patch)) {
    const double lemon = std::sqrt((p - patch.radius) * (p + patch.radius));
    out.literal("sphere{").point(center).literal(",").length(lemon).literal(" inverse}");
    // The two pieces of a spindle lie on opposite sides of the plane of the circle.
    const double height = glm::dot(patch.axis, patch.center);
    if (!patch.has_piece[0]) plane(out, {-patch.axis, -height}, patch.center);
    if (!patch.has_piece[1]) plane(out, {patch.axis, height}, patch.center);
  }
  part_half(out, patch, part);
  out.literal(cuts);
  const Box extent = toroidal_extent(surface_, patch);
  box(out, extent.low, extent.high);
  out.literal("}}");
}

// The centre of the visibility sphere is where the bisector of the angle at the probe meets the line through the atoms,
// so both contact points are equally far from it. The sphere meets the torus in the two contact circles only.
void PatchObjects::visibility_sphere(SceneText& out, const ToroidalPatch& patch) const {
  const double p = surface_.probe_radius;
  const Ball &a = surface_.atoms[patch.atom[0]], &b = surface_.atoms[patch.atom[1]];
  const double share = (a.radius + p) / (a.radius + b.radius + 2.0 * p);
  const glm::dvec3 center = a.center + share * (b.center - a.center);
  const glm::dvec3 probe = patch.center + patch.radius * patch.start;
  const glm::dvec3 contact = probe + (a.center - probe) * (p / (a.radius + p));
  out.literal("sphere{").point(center - origin_).literal(",").length(glm::distance(center, contact)).literal("}");
}

void PatchObjects::wedge(SceneText& out, const ToroidalPatch& patch) const {
  if (patch.free()) return;
  const glm::dvec3 side = glm::cross(patch.axis, patch.start);
  const glm::dvec3 end_side = std::cos(patch.sweep) * side - std::sin(patch.sweep) * patch.start;
  const bool reflex = patch.sweep > std::numbers::pi;
  if (reflex) out.literal("union{");
  plane(out, {-side, glm::dot(-side, patch.center)}, patch.center);
  plane(out, {end_side, glm::dot(end_side, patch.center)}, patch.center);
  if (reflex) out.literal("}");
}

// The points of a saddle that are equally near to both contact directions form a circle about the axis.
void PatchObjects::part_half(SceneText& out, const ToroidalPatch& patch, std::uint32_t part) const {
  const bool of_first = palette_.atom_part[patch.atom[0]] == part;
  if (of_first == (palette_.atom_part[patch.atom[1]] == part)) return;
  const glm::dvec3 probe = patch.center + patch.radius * patch.start;
  const glm::dvec3 middle = glm::normalize(glm::normalize(surface_.atoms[patch.atom[0]].center - probe) +
                                           glm::normalize(surface_.atoms[patch.atom[1]].center - probe));
  const glm::dvec3 border = probe + surface_.probe_radius * middle;
  const glm::dvec3 normal = of_first ? patch.axis : -patch.axis;
  plane(out, {normal, glm::dot(normal, border)}, patch.center);
}

void PatchObjects::concave(SceneText& out, const ConcavePatch& patch, std::uint32_t part, std::string_view cuts) const {
  out.literal("sphere{").point(patch.center - origin_).literal(",").length(surface_.probe_radius);
  out.literal(" clipped_by{");
  for (std::uint32_t n = 0; n < patch.plane_count(); ++n)
    plane(out, surface_.planes[patch.first_plane + n], patch.center);
  part_cells(out, patch, part);
  out.literal(cuts);
  const Box extent = concave_extent(surface_, patch);
  box(out, extent.low, extent.high);
  out.literal("}}");
}

// A point belongs to the part if one contact of that part is nearer than all contacts of other parts.
void PatchObjects::part_cells(SceneText& out, const ConcavePatch& patch, std::uint32_t part) const {
  std::vector<glm::dvec3> own, other;
  for (std::uint32_t n = 0; n < patch.contact_count; ++n) {
    const std::uint32_t atom = surface_.contacts[patch.first_contact + n];
    const glm::dvec3 direction = glm::normalize(surface_.atoms[atom].center - patch.center);
    (palette_.atom_part[atom] == part ? own : other).push_back(direction);
  }
  if (other.empty()) return;
  if (own.size() > 1) out.literal("union{");
  for (const glm::dvec3& near : own) {
    if (own.size() > 1 && other.size() > 1) out.literal("intersection{");
    for (const glm::dvec3& far : other) plane(out, nearer_to(near, far, patch.center), patch.center);
    if (own.size() > 1 && other.size() > 1) out.literal("}");
  }
  if (own.size() > 1) out.literal("}");
}

namespace {

// Extreme points this far outside of an arc or a plane are still included: the box may be too large, but never too
// small.
constexpr double kGenerous = 1e-9;

void include_face(Box& box, const Surface& surface, const Face& face) {
  for_each_border(surface, face, [&](const Border& border) {
    const Box arc = arc_extent(border);
    box.include(arc.low);
    box.include(arc.high);
  });
  if (face.tip != kNone) box.include(surface.vertices[face.tip]);
}

}  // namespace

Box arc_extent(const Border& b) {
  const glm::dvec3 side = glm::cross(b.axis, b.start);
  Box box;
  box.include(arc_point(b, 0.0));
  box.include(arc_point(b, b.sweep));
  for (int k = 0; k < 3; ++k) {
    const double turn = std::atan2(side[k], b.start[k]);  // the greatest coordinate; the least is half a turn later
    for (const double t : {turn, turn + std::numbers::pi}) {
      const double from_start = t < -kGenerous ? t + 2.0 * std::numbers::pi : t;
      if (from_start <= b.sweep + kGenerous) box.include(arc_point(b, from_start));
    }
  }
  return box;
}

Box toroidal_extent(const Surface& surface, const ToroidalPatch& patch) {
  Box box;
  for (const Face& face : faces_of(surface, patch)) include_face(box, surface, face);
  return box;
}

Box concave_extent(const Surface& surface, const ConcavePatch& patch) {
  Box box;
  for (const Face& face : faces_of(surface, patch)) include_face(box, surface, face);
  for (int k = 0; k < 3; ++k)
    for (const double sign : {-1.0, 1.0}) {
      glm::dvec3 pole = patch.center;
      pole[k] += sign * surface.probe_radius;
      bool inside = true;
      for (std::uint32_t n = 0; n < patch.plane_count(); ++n) {
        const Plane& plane = surface.planes[patch.first_plane + n];
        inside = inside && glm::dot(plane.normal, pole) <= plane.offset + kGenerous;
      }
      if (inside) box.include(pole);
    }
  return box;
}

}  // namespace meniscus::povray
