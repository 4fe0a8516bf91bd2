// SPDX-License-Identifier: BSD-3-Clause
// Builds the filled solid of a large probe, and spreads probes over the surface that they roll on.
#include "core/pockets/hull.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/math/ball_grid.h"
#include "core/math/spiral.h"
#include "core/queries/surface_parts.h"
#include "core/surface/primitives.h"

namespace meniscus {

Hull::Hull(Surface surface) : whole_(std::move(surface)), anywhere_(whole_) {
  const std::vector<bool> reached = reached_from_outside(whole_);
  for (std::size_t c = 0; c < reached.size(); ++c)
    if (reached[c]) volume_ += whole_.components[c].volume;
  if (std::ranges::find(reached, false) == reached.end()) return;
  part_ = part_of(whole_, reached).surface;
  outside_.emplace(*part_);
}

// If a probe may be at the point, it gets to the nearest place where it touches an atom without leaving such places. If
// that is not a place of the outside, the point lies in a cavity.
double Hull::to_probe(const glm::dvec3& point) const {
  const bool in_sas = anywhere_.in_sas(point);
  if (!outside_) return in_sas ? anywhere_.to_probe(point) : 0.0;
  const double outside = outside_->to_probe(point);
  return in_sas || anywhere_.to_probe(point) < outside ? outside : 0.0;
}

namespace {

/// Adds the wanted centres of fixed probes.
void add_fixed(const Surface& s, const NearWanted& wanted, std::vector<glm::dvec3>& places) {
  for (const ConcavePatch& patch : s.concave)
    if (wanted(patch.center, 0.0)) places.push_back(patch.center);
}

/// Adds wanted places along arcs, at most `step` (Å) apart.
void add_on_arcs(const Surface& s, double step, const NearWanted& wanted, std::vector<glm::dvec3>& places) {
  for (const ToroidalPatch& t : s.toroidal) {
    if (!wanted(t.center, t.radius)) continue;
    const auto count = static_cast<std::size_t>(std::ceil(t.sweep * t.radius / step));
    const glm::dvec3 across = glm::cross(t.axis, t.start);
    for (std::size_t n = t.free() ? 0 : 1; n < count; ++n) {
      const double angle = t.sweep * static_cast<double>(n) / static_cast<double>(count);
      const glm::dvec3 place = t.center + t.radius * (std::cos(angle) * t.start + std::sin(angle) * across);
      if (wanted(place, 0.0)) places.push_back(place);
    }
  }
}

/// Returns the first direction of a spiral of `count` directions that may lie above a height over a sphere's centre;
/// all later ones are higher.
std::size_t first_above(double height, double radius, std::size_t count) {
  const double n = 0.5 * (height / radius + 1.0) * static_cast<double>(count) - 2.0;  // one more, for rounding
  return n <= 0.0 ? 0 : n >= static_cast<double>(count) ? count : static_cast<std::size_t>(n);
}

/// Adds wanted places on the faces of the SAS.
void add_on_faces(const Surface& s, const PlaceSteps& steps, const Box& bounds, const NearWanted& wanted,
                  std::vector<glm::dvec3>& places) {
  for (const ConvexPatch& patch : s.convex) {
    const Ball& atom = s.atoms[patch.atom];
    const double radius = atom.radius + s.probe_radius;
    if (!wanted(atom.center, radius)) continue;
    const double step = steps.on_sphere(atom.radius);
    const std::span<const Plane> planes(s.planes.data() + patch.first_plane, patch.plane_count);
    const auto count = static_cast<std::size_t>(std::ceil(4 * std::numbers::pi * std::pow(radius / step, 2)));
    // The sphere of an atom far larger than others has far more places than are wanted.
    const std::size_t end = std::min(count, first_above(bounds.high.z - atom.center.z, radius, count) + 4);
    for (std::size_t n = first_above(bounds.low.z - atom.center.z, radius, count); n < end; ++n) {
      const glm::dvec3 direction = spiral_direction(n, count), foot = atom.center + atom.radius * direction;
      if (std::ranges::all_of(planes,
                              [&](const Plane& plane) { return glm::dot(plane.normal, foot) <= plane.offset; }) &&
          wanted(atom.center + radius * direction, 0.0))
        places.push_back(atom.center + radius * direction);
    }
  }
}

/// Returns the places without those that coincide with an earlier one.
std::vector<glm::dvec3> without_doubles(const std::vector<glm::dvec3>& places) {
  const BallGrid grid(places, 1.0);
  std::vector<bool> kept(places.size(), true);
  std::vector<glm::dvec3> result;
  for (std::uint32_t n = 0; n < places.size(); ++n) {
    grid.for_each_near(places[n], kSamePlace, [&](std::uint32_t m) { kept[n] = kept[n] && (m >= n || !kept[m]); });
    if (kept[n]) result.push_back(places[n]);
  }
  return result;
}

}  // namespace

std::vector<glm::dvec3> probe_places(const Surface& surface, const PlaceSteps& steps, const Box& bounds,
                                     const NearWanted& wanted) {
  std::vector<glm::dvec3> places;
  add_fixed(surface, wanted, places);
  add_on_arcs(surface, steps.on_arcs, wanted, places);
  add_on_faces(surface, steps, bounds, wanted, places);
  return without_doubles(places);
}

}  // namespace meniscus
