// SPDX-License-Identifier: BSD-3-Clause
// Samples the borders of a surface as finely as a mesh needs, and where colours change along them.
#include "core/mesh/border_samples.h"

#include <numbers>

#include <tbb/parallel_for.h>

#include "core/mesh/mesh_colors.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

/// Borders shorter than this (Å) are rounding noise of a degenerate position: their two ends are one vertex.
constexpr double kTinyBorder = 1e-9;
/// The largest angle (radian) of an edge by tolerance.
constexpr double kLargestAngle = 0.8;
/// The largest angle (radian) of an edge by length: circles have at least five parts.
constexpr double kLargestAngleOfParts = 1.3;
/// The distance that an edge h of requested length may leave a sphere of radius r is h^2/(3 r), twice that of an
/// equilateral triangle, but never more than this share of the radius.
constexpr double kLargestShare = 0.3;

bool is_whole_circle(const Border& border) { return border.vertex[0] == kNone; }

}  // namespace

double EdgeRule::edge(double radius) const {
  if (edge_ > 0.0) return std::min(edge_, angle_ * radius);
  return std::min(std::sqrt(5.0 * radius * tolerance_), kLargestAngle * radius);
}

double EdgeRule::chord(double radius) const { return edge_ > 0.0 ? edge_ : 0.9 * std::sqrt(8.0 * radius * tolerance_); }

int EdgeRule::parts(double steps) const {
  return std::max(1, static_cast<int>(edge_ > 0.0 ? std::round(steps) : std::ceil(steps)));
}

double EdgeRule::largest_angle() const { return edge_ > 0.0 ? std::max(angle_, kLargestAngleOfParts) : kLargestAngle; }

double EdgeRule::tolerance(double radius) const {
  return edge_ > 0.0 && radius > 0.0 ? std::min(edge_ * edge_ / (3.0 * radius), kLargestShare * radius) : tolerance_;
}

double tube_radius(const Surface& surface, const Face& face) {
  return face.kind == PatchKind::convex ? surface.atoms[surface.convex[face.patch].atom].radius : surface.probe_radius;
}

double tolerance_of(const EdgeRule& rule, const Surface& surface, const Face& face) {
  const double radius = tube_radius(surface, face);
  if (face.kind != PatchKind::toroidal || !rule.is_strip(radius)) return rule.tolerance(radius);
  const auto& [a, b] = surface.toroidal[face.patch].atom;
  return rule.tolerance(std::max(surface.atoms[a].radius, surface.atoms[b].radius));
}

BorderSamples::BorderSamples(const Surface& surface, const EdgeRule& rule, bool split_colors)
    : surface_(surface), parameters_(surface.borders.size()) {
  join_ends_of_tiny_borders();
  tbb::parallel_for(std::size_t{0}, surface.borders.size(),
                    [&](std::size_t b) { sample(static_cast<std::uint32_t>(b), rule, split_colors); });
  // Two borders between the same two vertices would become the same edge if each were one segment.
  std::vector<std::array<std::uint32_t, 3>> single;  // both ends, and the border
  for (std::uint32_t b = 0; b < surface.borders.size(); ++b) {
    if (segment_count(b) != 1) continue;
    const auto [from, to] = std::minmax({point(b, 0).index, point(b, 1).index});
    single.push_back({from, to, b});
  }
  std::sort(single.begin(), single.end());
  for (std::size_t n = 1; n < single.size(); ++n)
    if (single[n][0] == single[n - 1][0] && single[n][1] == single[n - 1][1]) split(single[n][2], 0);
}

void BorderSamples::join_ends_of_tiny_borders() {
  representative_.resize(surface_.vertices.size());
  for (std::uint32_t v = 0; v < representative_.size(); ++v) representative_[v] = v;
  for (const Border& border : surface_.borders) {
    if (is_whole_circle(border) || border.radius * border.sweep > kTinyBorder) continue;
    std::uint32_t a = representative(border.vertex[0]), b = representative(border.vertex[1]);
    if (a > b) std::swap(a, b);
    representative_[b] = a;
  }
}

std::uint32_t BorderSamples::representative(std::uint32_t vertex) const {
  while (representative_[vertex] != vertex) vertex = representative_[vertex];
  return vertex;
}

void BorderSamples::sample(std::uint32_t index, const EdgeRule& rule, bool split_colors) {
  const Border& border = surface_.borders[index];
  std::vector<double>& t = parameters_[index];
  if (!is_whole_circle(border) && representative(border.vertex[0]) == representative(border.vertex[1]) &&
      border.radius * border.sweep <= kTinyBorder) {
    return;
  }
  double step = rule.chord(border.radius);
  std::vector<double> stops;
  for (std::uint32_t f : border.face) {
    const Face& face = surface_.faces[f];
    const double tube = tube_radius(surface_, face);
    const bool along_strip =
        face.kind == PatchKind::toroidal && border.kind == BorderKind::contact && rule.is_strip(tube);
    if (tube > 0.0 && !along_strip) step = std::min(step, rule.edge(tube));
    if (face.kind == PatchKind::toroidal) {
      // Both contact circles of a saddle get equal steps: without a probe they are one circle, and must stay one.
      for (const std::uint32_t atom : surface_.toroidal[face.patch].atom) {
        step = std::min(step, rule.edge(surface_.atoms[atom].radius));
      }
    }
    if (!split_colors || face.kind == PatchKind::convex || border.kind == BorderKind::contact) continue;
    const bool concave = face.kind == PatchKind::concave;
    const glm::dvec3 probe = concave ? surface_.concave[face.patch].center : border.center;
    const auto contacts = concave ? contact_directions(surface_, surface_.concave[face.patch])
                                  : contact_directions(surface_, surface_.toroidal[face.patch], probe);
    const auto changes = color_changes(contacts, probe, border);
    stops.insert(stops.end(), changes.begin(), changes.end());
  }
  const double angle = std::min(step / border.radius, rule.largest_angle());
  std::sort(stops.begin(), stops.end());
  const double apart = std::min(1e-3 * angle, 0.25 * border.sweep);  // closer stops become one
  double from = 0.0;
  const auto go_to = [&](double to) {
    const double span = to - from;
    const int parts = rule.parts(span / angle);
    t.reserve(t.size() + static_cast<std::size_t>(parts) + 1);
    for (int k = 0; k < parts; ++k) t.push_back(from + span * k / parts);
    from = to;
  };
  for (const double stop : stops)
    if (!(stop - from < apart || border.sweep - stop < apart)) go_to(stop);
  go_to(border.sweep);
  if (!is_whole_circle(border)) t.push_back(border.sweep);
}

std::uint32_t BorderSamples::segment_count(std::uint32_t border) const {
  const std::size_t n = parameters_[border].size();
  return static_cast<std::uint32_t>(n == 0 || is_whole_circle(surface_.borders[border]) ? n : n - 1);
}

BorderPoint BorderSamples::point(std::uint32_t border, std::uint32_t k) const {
  const Border& b = surface_.borders[border];
  const std::uint32_t n = segment_count(border);
  if (is_whole_circle(b)) return {border, k % n};
  if (k == 0) return {kNone, representative(b.vertex[0])};
  if (k == n) return {kNone, representative(b.vertex[1])};
  return {border, k};
}

double BorderSamples::parameter(std::uint32_t border, std::uint32_t k) const {
  const auto& t = parameters_[border];
  return k < t.size() ? t[k] : surface_.borders[border].sweep;
}

glm::dvec3 BorderSamples::position(std::uint32_t border, std::uint32_t k) const { return position(point(border, k)); }

glm::dvec3 BorderSamples::position(BorderPoint p) const {
  if (p.border == kNone) return surface_.vertices[p.index];
  return arc_point(surface_.borders[p.border], parameters_[p.border][p.index]);
}

void BorderSamples::split(std::uint32_t border, std::uint32_t segment) {
  const double middle = 0.5 * (parameter(border, segment) + parameter(border, segment + 1));
  auto& t = parameters_[border];
  t.insert(t.begin() + segment + 1, middle);
  split_.push_back(border);
}

}  // namespace meniscus
