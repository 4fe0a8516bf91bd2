// SPDX-License-Identifier: BSD-3-Clause
// The reduced surface as Sanner, Olson & Spehner 1996 (section 3.1) find it: a probe that rolls from face to face.
//
// This code shares nothing with contour build-up: no arcs are cut and kept. A rolling step compares angles from the
// probe's position to the point where it meets each ball (Sanner, Olson & Spehner 1996, section 3.1); a position is
// tested against every ball in turn.
#pragma once

#include "core/base/constants.h"
#include "core/math/double_geometry.h"
#include "core/math/quad_geometry.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

/// An atom that overlaps the circle's first atom, relative to that atom; weight: its decision weight.
struct RollingNeighbor {
  glm::dvec3 center{0.0};
  double weight = 0.0;
  std::uint32_t atom = 0;
};

struct DoublePrecision {
  using real = double;
  using real2 = geometry::real2;
  using HalfPlane = geometry::HalfPlane;
  using CoveredArc = geometry::CoveredArc;
  using Circle = geometry::Circle;
  static constexpr bool kCertain = false;
  static constexpr real kRoundoff = geometry::kUnitRoundoff;
  static geometry::real3 vector(const glm::dvec3& a) { return a; }
  static Circle circle(const glm::dvec3& d, double w0, double w1) { return geometry::circle_of_two_spheres(d, w0, w1); }
  static real sweep(real a, real b) { return geometry::pseudo_sweep(a, b); }
  static real pseudo(real2 a) { return geometry::pseudo_angle(a); }
  static real2 direction(real a) { return geometry::direction_at(a); }
  static real root(real a) { return std::sqrt(a); }
};

struct QuadPrecision {
  using real = quad_geometry::real;
  using real2 = quad_geometry::real2;
  using HalfPlane = quad_geometry::HalfPlane;
  using CoveredArc = quad_geometry::CoveredArc;
  using Circle = quad_geometry::Circle;
  static constexpr bool kCertain = true;
  static constexpr real kRoundoff = 0x1p-113;
  static quad_geometry::real3 vector(const glm::dvec3& a) { return {a.x, a.y, a.z}; }
  static Circle circle(const glm::dvec3& d, double w0, double w1) {
    return quad_geometry::circle_of_two_spheres(vector(d), w0, w1);
  }
  static real sweep(real a, real b) { return quad_geometry::pseudo_sweep(a, b); }
  static real pseudo(real2 a) { return quad_geometry::pseudo_angle(a); }
  static real2 direction(real a) { return quad_geometry::direction_at(a); }
  static real root(real a) { return quad_geometry::sqrt(a); }
};

/// In quadruple precision every result is final; in double, only while certain() is true. Reused from circle to circle.
template <typename Precision>
class RollingCircle {
 public:
  using real = typename Precision::real;

  /// Sets the circle of the balls (0, w0) and neighbors[skip], with the other neighbours around it.
  void place(double w0, std::span<const RollingNeighbor> neighbors, std::size_t skip) {
    certain_ = true;
    covered_ = false;
    met_.clear();
    circle_ = Precision::circle(neighbors[skip].center, w0, neighbors[skip].weight);
    if (!Precision::kCertain && circle_.radius_squared <= 1e-13 * w0) certain_ = false;
    if (!certain_) return;
    covered_ = !(circle_.radius_squared > 0);
    for (std::size_t n = 0; n < neighbors.size() && certain_ && !covered_; ++n)
      if (n != skip) add(w0, neighbors[n]);
  }

  bool certain() const { return certain_; }
  bool covered() const { return covered_; }                ///< true if a single ball covers it, or there is no circle
  bool free() const { return !covered_ && met_.empty(); }  ///< no ball meets it
  std::size_t met_count() const { return met_.size(); }
  std::uint32_t met_atom(std::size_t n) const { return met_[n].atom; }

  /// Rolls away from atom k, which the probe touches: counter-clockwise from the end of the part that k covers, or
  /// clockwise from its begin. Returns the first atom met (k itself after nearly a whole turn); kNone if k does not
  /// meet the circle.
  std::uint32_t roll(std::uint32_t k, bool counter_clockwise) {
    const auto from = std::find_if(met_.begin(), met_.end(), [&](const Met& m) { return m.atom == k; });
    if (from == met_.end()) return kNone;
    return first_from(counter_clockwise ? from->covered.end : from->covered.begin, from->covered.error,
                      counter_clockwise);
  }

  /// Returns the first atom met counter-clockwise from a point of the circle that no ball covers, given relative to the
  /// circle's first ball; kNone on a free circle.
  std::uint32_t first_from(const glm::dvec3& point) {
    const auto x = Precision::vector(point);
    const real u = dot(circle_.u, x), v = dot(circle_.v, x);
    return first_from(Precision::pseudo(typename Precision::real2{u, v}), real(0), true);
  }

  /// Returns true if the probe fits where it meets the n-th met ball: where that ball's covered part begins, or ends.
  bool accessible(std::size_t n, bool at_end) {
    const auto& at = met_[n].covered;
    const auto x = Precision::direction(at_end ? at.end : at.begin);
    for (std::size_t m = 0; m < met_.size(); ++m) {
      if (m == n) continue;
      const auto& h = met_[m].half_plane;
      const real depth = dot(h.normal, x) - h.offset;
      const real length = h.length_squared + real(1);  // at least the length of the normal
      if (!Precision::kCertain && (depth < 0 ? -depth : depth) <= h.error + 2 * length * at.error) {
        certain_ = false;
        return false;
      }
      if (depth > 0) return false;
    }
    return true;
  }

 private:
  struct Met {
    typename Precision::HalfPlane half_plane;
    typename Precision::CoveredArc covered;
    std::uint32_t atom;
  };

  void add(double w0, const RollingNeighbor& neighbor) {
    const auto q = Precision::vector(neighbor.center);
    // A ball that is far outside the circle, or contains all of it by far, needs no half-plane.
    const real along = dot(circle_.axis, q), qq = dot(q, q);
    const real offset = (w0 + qq - neighbor.weight) / 2 - circle_.height * along;
    if (offset * offset > (qq - along * along) * circle_.radius_squared * real(1 + 1e-9) + real(1e-9)) {
      covered_ = covered_ || offset < 0;
      return;
    }
    const auto h =
        covered_half_plane(circle_, real(w0), q, Precision::root(qq), real(neighbor.weight), Precision::kRoundoff);
    real margin = 0;
    const int meeting = meet_circle(h, margin);
    if (!Precision::kCertain && margin <= 0) certain_ = false;
    if (meeting == geometry::kCovers) covered_ = true;
    if (meeting == geometry::kCuts) met_.push_back({h, covered_arc(h), neighbor.atom});
  }

  std::uint32_t first_from(real start, real start_error, bool counter_clockwise) {
    std::uint32_t first = kNone;
    real least = 5, second = 5, error = 0;
    for (const Met& m : met_) {
      const real angle =
          counter_clockwise ? Precision::sweep(start, m.covered.begin) : Precision::sweep(m.covered.end, start);
      // The point is nearly at the start: just before it or just after.
      const real blur = m.covered.error + start_error + 8 * Precision::kRoundoff;
      if (!Precision::kCertain && (angle <= blur || angle >= 4 - blur)) certain_ = false;
      error = std::max(error, blur);
      if (angle < least) {
        second = least;
        least = angle;
        first = m.atom;
      } else if (angle < second) {
        second = angle;
      }
    }
    if (!Precision::kCertain && second - least <= 2 * error) certain_ = false;
    return first;
  }

  typename Precision::Circle circle_;
  std::vector<Met> met_;
  bool certain_ = true;
  bool covered_ = false;
};

/// The part of the surface that the probe explores.
enum class RollingScope {
  /// The part that rolling reaches from the leftmost atom: one component, no cavities (the classical algorithm).
  outer_component,
  /// Everything. Rolling cannot leave its component, so each circle of two atoms is searched for positions where the
  /// probe touches a third atom; at each unvisited position it starts again. Free edges, to which no face leads, are
  /// found on the way. The result equals enumerate_reduced_surface().
  complete
};

/// Rolls a probe over the atoms, in one thread. atoms in Å, probe_radius >= 0 in Å. It shares decision weights and
/// predicates with the contour build-up but neither its search nor its bookkeeping, and so checks it.
ReducedSurface roll_probe(std::span<const Ball> atoms, double probe_radius,
                          RollingScope scope = RollingScope::complete);

}  // namespace meniscus
