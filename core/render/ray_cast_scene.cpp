// SPDX-License-Identifier: BSD-3-Clause
// Packing patches and their bounds; every number is made in double and rounded once.
#include "core/render/ray_cast_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

#include <glm/geometric.hpp>

namespace meniscus {
namespace {

using ray_cast::Primitive;

/// A sphere around a patch.
struct Bound {
  glm::dvec3 center{0.0};
  double radius = 0.0;
};

/// The part of a sphere that sees `axis` at an angle whose cosine is at least `cosine`.
Bound cap_bound(const glm::dvec3& center, double radius, const glm::dvec3& axis, double cosine) {
  if (cosine <= 0.0) return {center, radius};
  return {center + axis * (radius * cosine), radius * std::sqrt(std::max(1.0 - cosine * cosine, 0.0))};
}

/// How far from its centre a spindle comes to its axis, Å.
double tip_height(const ToroidalPatch& patch, double probe_radius) {
  return std::sqrt((probe_radius - patch.radius) * (probe_radius + patch.radius));
}

class Packer {
 public:
  Packer(const Surface& surface, const Coloring& coloring, const PictureFrame& frame, RayCastScene& scene)
      : surface_(surface), coloring_(coloring), frame_(frame), scene_(scene) {}

  void pack() {
    const auto& s = surface_;
    scene_.primitives.reserve(s.convex.size() + s.toroidal.size() + s.concave.size());
    double extent = 0.0;
    for (const Ball& ball : s.atoms)
      extent = std::max(extent, glm::length(ball.center - frame_.pivot) + ball.radius + s.probe_radius);
    // Centres are rounded to 2^-24 of the extent; rays to a little more. A local coordinate is a few Å.
    scene_.slack = static_cast<float>(1e-5 + 2.5e-7 * extent);
    for (std::uint32_t i = 0; i < s.convex.size(); ++i) pack(s.convex[i], i);
    if (s.probe_radius > 0.0) {  // a probe of no size leaves these patches without area
      for (std::uint32_t i = 0; i < s.toroidal.size(); ++i) pack(s.toroidal[i], i);
      for (std::uint32_t i = 0; i < s.concave.size(); ++i) pack(s.concave[i], i);
    }
    std::ranges::stable_sort(scene_.primitives, {}, &Primitive::nearest);
  }

 private:
  void add_row(const glm::dvec3& v, double w) { scene_.rows.emplace_back(glm::vec3(v), static_cast<float>(w)); }

  void add_planes(std::uint32_t first, std::uint32_t count, const glm::dvec3& center) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Plane& plane = surface_.planes[i];
      add_row(plane.normal, plane.offset - glm::dot(plane.normal, center));
    }
  }

  /// False when nothing of the bound lies in front of the camera.
  bool begin(const Bound& bound, PatchKind kind, std::uint32_t index, Primitive& primitive) {
    const double radius = bound.radius * (1.0 + 1e-6) + 4.0 * scene_.slack;
    const glm::dvec3 center = bound.center - frame_.pivot;
    const double depth = frame_.eye_distance + glm::dot(center, frame_.basis.forward);
    if (depth + radius <= 0.0) return false;
    const double distance = frame_.camera.projection == Projection::orthographic
                                ? depth
                                : glm::length(bound.center - frame_.camera.position);
    primitive.bound = glm::vec4(glm::vec3(center), static_cast<float>(radius));
    primitive.nearest = static_cast<float>((distance - radius) - 1e-6 * (std::abs(distance) + radius));
    primitive.first_row = static_cast<std::uint32_t>(scene_.rows.size());
    primitive.kind = static_cast<std::uint32_t>(kind);
    primitive.patch_index = index;
    return true;
  }

  bool shows_none(std::span<const std::uint32_t> atoms) const {
    return std::ranges::none_of(atoms, [&](std::uint32_t a) { return coloring_.shows(a); });
  }

  void pack(const ConvexPatch& patch, std::uint32_t index) {
    if (!coloring_.shows(patch.atom)) return;
    const Ball& ball = surface_.atoms[patch.atom];
    Bound bound{ball.center, ball.radius};
    for (std::uint32_t i = patch.first_plane; i < patch.first_plane + patch.plane_count; ++i) {
      const Plane& plane = surface_.planes[i];
      const double cosine = (glm::dot(plane.normal, ball.center) - plane.offset) / ball.radius;
      const Bound cap = cap_bound(ball.center, ball.radius, -plane.normal, std::min(cosine, 1.0));
      if (cap.radius < bound.radius) bound = cap;
    }
    Primitive primitive{};
    if (!begin(bound, PatchKind::convex, index, primitive)) return;
    primitive.plane_count = patch.plane_count;
    primitive.atom = patch.atom;
    add_row(ball.center - frame_.pivot, ball.radius);
    add_planes(patch.first_plane, patch.plane_count, ball.center);
    scene_.primitives.push_back(primitive);
  }

  void pack(const ToroidalPatch& patch, std::uint32_t index) {
    if (shows_none(patch.atom)) return;
    const double p = surface_.probe_radius;
    double height[2], extended[2], contact_z[2], contact_rho[2];
    for (int i = 0; i < 2; ++i) {
      const Ball& ball = surface_.atoms[patch.atom[i]];
      height[i] = glm::dot(ball.center - patch.center, patch.axis);
      extended[i] = ball.radius + p;
      contact_z[i] = height[i] * (p / extended[i]);
      contact_rho[i] = patch.radius * (ball.radius / extended[i]);
    }
    const double clip_z = 0.5 * (contact_z[0] + contact_z[1]) + 0.5 * (contact_rho[1] - contact_rho[0]) *
                                                                    (contact_rho[1] + contact_rho[0]) /
                                                                    (contact_z[1] - contact_z[0]);
    const double clip_radius = std::hypot(contact_rho[0], contact_z[0] - clip_z);
    const glm::dvec3 y_axis = glm::cross(patch.axis, patch.start);

    // In cylinder coordinates the patch lies in a box; the farthest point from the centre is one of its corners.
    const double rho_low = std::max(patch.radius - p, 0.0), rho_high = std::max(contact_rho[0], contact_rho[1]);
    const double half_sweep = std::min(0.5 * patch.sweep, std::numbers::pi);
    const double rho_mid =
        half_sweep < 0.5 * std::numbers::pi ? 0.5 * (rho_low + rho_high) * std::cos(half_sweep) : 0.0;
    const double z_mid = 0.5 * (contact_z[0] + contact_z[1]);
    double radius_squared = 0.0;
    for (const double rho : {rho_low, rho_high})
      for (const double angle : {0.0, half_sweep}) {
        const double across = rho * rho + rho_mid * rho_mid - 2.0 * rho * rho_mid * std::cos(angle);
        const double along = 0.5 * (contact_z[1] - contact_z[0]);
        radius_squared = std::max(radius_squared, across + along * along);
      }
    const glm::dvec3 middle = patch.start * std::cos(0.5 * patch.sweep) + y_axis * std::sin(0.5 * patch.sweep);
    Primitive primitive{};
    if (!begin({patch.center + middle * rho_mid + patch.axis * z_mid, std::sqrt(radius_squared)}, PatchKind::toroidal,
               index, primitive))
      return;
    primitive.plane_count = patch.free() ? 0 : patch.sweep <= std::numbers::pi ? 1 : 2;
    primitive.atom = patch.atom[0];
    primitive.second_atom = patch.atom[1];
    add_row(patch.center - frame_.pivot, patch.radius);
    add_row(patch.start, std::cos(patch.sweep));
    add_row(patch.axis, std::sin(patch.sweep));
    double z_low = contact_z[0], z_high = contact_z[1];
    if (!patch.has_piece[0]) z_low = tip_height(patch, p);
    if (!patch.has_piece[1]) z_high = -tip_height(patch, p);
    add_row({z_low, z_high, clip_z}, clip_radius);
    add_row({height[0], extended[0], height[1]}, extended[1]);
    scene_.primitives.push_back(primitive);
  }

  void pack(const ConcavePatch& patch, std::uint32_t index) {
    if (patch.face_count == 0 || shows_none({&surface_.contacts[patch.first_contact], patch.contact_count})) return;
    const double p = surface_.probe_radius;
    std::vector<glm::dvec3> directions(patch.contact_count);
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < patch.contact_count; ++i) {
      directions[i] = glm::normalize(surface_.atoms[surface_.contacts[patch.first_contact + i]].center - patch.center);
      sum += directions[i];
    }
    // A cap of at most half a sphere is convex on the sphere: it holds the patch if it holds the contacts.
    Bound bound{patch.center, p};
    if (glm::length(sum) > 1e-6) {
      const glm::dvec3 axis = glm::normalize(sum);
      double cosine = 1.0;
      for (const glm::dvec3& direction : directions) cosine = std::min(cosine, glm::dot(direction, axis));
      bound = cap_bound(patch.center, p, axis, cosine);
    }
    Primitive primitive{};
    if (!begin(bound, PatchKind::concave, index, primitive)) return;
    primitive.plane_count = patch.plane_count();
    primitive.atom = patch.contact_count;
    add_row(patch.center - frame_.pivot, p);
    add_planes(patch.first_plane, primitive.plane_count, patch.center);
    for (std::uint32_t i = 0; i < patch.contact_count; ++i)
      scene_.rows.emplace_back(glm::vec3(directions[i]),
                               std::bit_cast<float>(surface_.contacts[patch.first_contact + i]));
    scene_.primitives.push_back(primitive);
  }

  const Surface& surface_;
  const Coloring& coloring_;
  const PictureFrame& frame_;
  RayCastScene& scene_;
};

}  // namespace

PictureFrame make_picture_frame(const Surface& surface, const Camera& camera, glm::ivec2 size) {
  PictureFrame frame;
  frame.camera = camera;
  frame.basis = view_basis(camera);
  frame.size = size;
  // The pivot: the first ball on the view axis, else as deep as the balls are on average.
  double first = std::numeric_limits<double>::max(), mean = 0.0;
  for (const Ball& ball : surface.atoms) {
    const glm::dvec3 v = ball.center - camera.position;
    const double along = glm::dot(v, frame.basis.forward);
    mean += along / static_cast<double>(surface.atoms.size());
    const glm::dvec3 across = v - frame.basis.forward * along;
    const double room = ball.radius * ball.radius - glm::dot(across, across);
    if (room > 0.0 && along + std::sqrt(room) > 0.0) first = std::min(first, along - std::sqrt(room));
  }
  if (first == std::numeric_limits<double>::max()) first = mean;
  frame.eye_distance = std::max(first, 1.0);  // a perspective camera needs some distance; 1 Å does inside an atom too
  frame.pivot = camera.position + frame.basis.forward * frame.eye_distance;
  const double half_height = half_extent(camera, 1.0).y;
  frame.pixel_size = 2.0 * half_height / size.y;
  if (camera.projection == Projection::perspective) frame.pixel_size *= frame.eye_distance;
  return frame;
}

RayCastScene pack_scene(const Surface& surface, const Coloring& coloring, const PictureFrame& frame) {
  RayCastScene scene;
  Packer(surface, coloring, frame, scene).pack();
  return scene;
}

}  // namespace meniscus
