// SPDX-License-Identifier: BSD-3-Clause
// Contour build-up of one circle: double with an error bound first, quadruple precision where that leaves doubt.
#include "core/reduced_surface/contour/contour.h"

#include <algorithm>
#include <cmath>

#include "core/math/quad_geometry.h"

namespace meniscus {
namespace {

struct QuadArc {
  quad_geometry::real begin;
  quad_geometry::real end;
  std::uint32_t begin_by;
  std::uint32_t end_by;
};

// What is left of a circle while balls cover it, in either precision: the geometry functions are found by the
// namespace of their arguments.
template <typename Arc, typename Real>
struct Remainder {
  bool whole = true;
  std::vector<Arc>& arcs;
  Real error = 0;  // of any end point so far
  Real roundoff;

  bool gone() const { return !whole && arcs.empty(); }

  // Takes away what a half-plane covers that is known to cut the circle. False when the bounds on the rounding errors
  // cannot exclude another outcome.
  template <typename HalfPlane>
  bool cover(const HalfPlane& h, std::uint32_t label) {
    const auto covered = covered_arc(h);
    error = std::max<Real>(error, covered.error);
    const Arc rest{covered.end, covered.begin, label, label};
    if (whole) {
      whole = false;
      arcs.push_back(rest);
      return true;
    }
    const Real enough = 2 * error + 16 * roundoff;
    bool sure = true;
    std::size_t kept = 0;
    for (std::size_t n = 0, count = arcs.size(); n < count; ++n) {
      Arc arc = arcs[n];
      Real margin = 0;
      const int change = clip_arc(arc.begin, arc.end, covered, margin);
      sure = sure && margin > enough;
      if (change == geometry::kRemove) continue;
      if (change == geometry::kComplement) {
        arc = rest;
      } else if (change == geometry::kSplit) {
        arcs.push_back({covered.end, arc.end, label, arc.end_by});  // at most one arc is split
        arc.end = covered.begin;
        arc.end_by = label;
      } else if (change == geometry::kCutBegin) {
        arc.begin = covered.end;
        arc.begin_by = label;
      } else if (change == geometry::kCutEnd) {
        arc.end = covered.begin;
        arc.end_by = label;
      }
      arcs[kept++] = arc;
      if (n + 1 == count && arcs.size() > count) arcs[kept++] = arcs[count];
    }
    arcs.resize(kept);
    return sure;
  }
};

quad_geometry::real3 quad(const glm::dvec3& a) { return {a.x, a.y, a.z}; }

}  // namespace

void Blockers::restart(double first_weight) {
  first_weight_ = first_weight;
  balls_.clear();
}

void Blockers::add(const glm::dvec3& center, double weight, std::uint32_t label) {
  const double square = glm::dot(center, center);
  balls_.push_back({center, square, (first_weight_ + square - weight) * 0.5, std::sqrt(square), weight, label});
}

void Blockers::sort() {
  std::sort(balls_.begin(), balls_.end(), [](const Ball& a, const Ball& b) { return a.square < b.square; });
}

void Contour::expose(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip,
                     std::span<const BlockedHalf> halves) {
  const double w0 = blockers.first_weight();
  circle_ = geometry::circle_of_two_spheres(d, w0, w1);
  whole_ = false;
  arcs_.clear();
  const double barely = 1024 * geometry::kUnitRoundoff * w0;
  if (circle_.radius_squared < -barely) return;
  // Where the spheres barely meet, if they do, the sign itself needs the better arithmetic.
  if (circle_.radius_squared <= barely || !expose_in_double(blockers, skip, halves)) {
    ++doubtful_count_;
    arcs_.clear();
    expose_in_quad(d, w1, blockers, skip, halves);
  }
}

bool Contour::expose_in_double(const Blockers& blockers, std::size_t skip, std::span<const BlockedHalf> halves) {
  Remainder<ExposedArc, double> left{true, arcs_, 0.0, geometry::kUnitRoundoff};
  for (const BlockedHalf& half : halves) {
    if (!left.cover(half.half_plane, half.label)) return false;
    if (left.gone()) break;
  }
  const double inverse_radius = circle_.inverse_radius;
  const double w0 = blockers.first_weight();
  const double noise = geometry::half_plane_noise(circle_, geometry::kUnitRoundoff);
  for (std::size_t n = 0; n < blockers.size() && !left.gone(); ++n) {
    if (n == skip) continue;
    const Blockers::Ball& b = blockers[n];
    // Most balls miss the circle or cover all of it; that needs no half-plane.
    const double along = glm::dot(circle_.axis, b.center);
    const double offset = (b.half_power - circle_.height * along) * inverse_radius;
    const double beyond = std::abs(offset) - noise * (b.square + w0) * (1 + b.distance * inverse_radius);
    if (beyond > 0 && beyond * beyond > b.square * (1 + 1e-14) - along * along) {
      if (offset > 0) continue;
      left.whole = false;
      arcs_.clear();
      break;
    }
    const geometry::HalfPlane h =
        geometry::covered_half_plane(circle_, w0, b.center, b.distance, b.weight, geometry::kUnitRoundoff);
    double margin = 0;
    const int meeting = geometry::meet_circle(h, margin);
    if (!(margin > 0)) return false;
    if (meeting == geometry::kMisses) continue;
    if (meeting == geometry::kCovers) {
      left.whole = false;
      arcs_.clear();
    } else if (!left.cover(h, b.label)) {
      return false;
    }
  }
  whole_ = left.whole;
  return true;
}

void Contour::expose_in_quad(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip,
                             std::span<const BlockedHalf> halves) {
  namespace q = quad_geometry;
  const q::real epsilon = 0x1p-113;
  const double w0 = blockers.first_weight();
  q::Circle circle = q::circle_of_two_spheres(quad(d), w0, w1);
  if (!(circle.radius_squared > 0)) return;
  std::vector<QuadArc> arcs;
  Remainder<QuadArc, q::real> left{true, arcs, 0, epsilon};
  // The frame is the one in double but for rounding, so that the half-planes given by the caller mean the same.
  for (const BlockedHalf& half : halves) {
    const geometry::HalfPlane& h = half.half_plane;
    left.cover(q::HalfPlane{{h.normal.x, h.normal.y}, h.offset, h.length_squared, h.length_bound, 0}, half.label);
    if (left.gone()) break;
  }
  for (std::size_t n = 0; n < blockers.size() && !left.gone(); ++n) {
    if (n == skip) continue;
    const Blockers::Ball& b = blockers[n];
    const q::HalfPlane h = q::covered_half_plane(circle, w0, quad(b.center), b.distance, b.weight, epsilon);
    q::real margin = 0;
    const int meeting = q::meet_circle(h, margin);
    if (meeting == q::kMisses) continue;
    if (meeting == q::kCovers) return;
    left.cover(h, b.label);
  }
  whole_ = left.whole;
  circle_.radius = static_cast<double>(circle.radius);
  circle_.radius_squared = circle_.radius * circle_.radius;
  for (const QuadArc& a : arcs)
    arcs_.push_back({static_cast<double>(a.begin), static_cast<double>(a.end), a.begin_by, a.end_by});
}

}  // namespace meniscus
