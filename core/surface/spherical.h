// SPDX-License-Identifier: BSD-3-Clause
// Regions on a sphere bounded by circular arcs, and the arcs that half-spaces leave of circles.
#pragma once

#include <numbers>
#include <utility>

#include "core/surface/primitives.h"

namespace meniscus {

/// One step of a loop on the unit sphere: an arc of the circle dot(axis, u) = height from the point `from` to the point
/// `to`, counter-clockwise about the axis unless the sweep is negative. A sweep of 0 has a sign, too: an arc without
/// length still has a direction, which the corners on both sides of it need.
struct SphereArc {
  glm::dvec3 axis{0.0};  ///< unit vector
  double height = 0.0;
  glm::dvec3 from{0.0};  ///< unit vector
  glm::dvec3 to{0.0};    ///< unit vector
  double sweep = 0.0;    ///< radians
  bool whole = false;    ///< a whole circle without vertices

  bool clockwise() const { return std::signbit(sweep); }
};

/// Returns a half-border as a step on the unit sphere around `center` of radius `radius`. Faces seen from the sphere's
/// inside (concave patches) have their region on the left of the reversed walk.
SphereArc sphere_arc(const Border& border, bool backwards, const glm::dvec3& center, double radius);

/// Writes a loop of a spherical face to `arcs`, as a walk on the unit sphere with the face on its left.
void walk_loop(const Surface& surface, const Loop& loop, const glm::dvec3& center, double radius, bool seen_from_inside,
               std::vector<SphereArc>& arcs);

/// Returns the area of the disc on the left of a closed loop with interior angles of at most pi: 2 pi less its total
/// turning, which is its geodesic curvature plus the exterior angles at its corners (Gauss-Bonnet). The area lies
/// between 0 and 4 pi up to rounding, provided that the loop is closed; see misfit_of().
double area_left_of(std::span<const SphereArc> loop);

/// Returns how far the loop is from closing, relative to its smallest circle: the largest step from the end of an arc
/// to the beginning of the next, over the smaller radius of the two. The turning at that corner is wrong by as many
/// radians. As a rule this is rounding; it is larger where a tie was decided for spheres that differ by more than the
/// circle.
double misfit_of(std::span<const SphereArc> loop);

/// Returns the length of the shortest arc that has ends, in radians; at most 1.
double shortest_of(std::span<const SphereArc> loop);

/// A circle of the unit sphere with a start: height*axis + cos t * x + sin t * y, counter-clockwise about the axis; |x|
/// = |y| = its radius.
struct SphereCircle {
  glm::dvec3 axis;
  double height;
  glm::dvec3 x, y;
};

/// Returns the circle of an arc, turned so that the arc runs counter-clockwise from t = 0 to t = |sweep|.
SphereCircle circle_of(const SphereArc& arc);

/// Returns the integral of (1 - cos theta) d phi along a circle from t = from to t = to; theta and phi are polar
/// coordinates about `pole`. Along the border of a region these integrals add up to the region's area, less 4 pi if the
/// region contains the antipode of the pole. Unlike the turning, the integral needs no tangents, which tiny circles do
/// not have.
double area_swept_from(const glm::dvec3& pole, const SphereCircle& circle, double from, double to);

/// Returns the same integral along closed loops, with the small steps from the end of each arc to the next.
double area_swept_from(const glm::dvec3& pole, std::span<const SphereArc> loop);

/// Returns the integral of the unit vector u over the region left of the loops: half the sum of integrals of u x du.
glm::dvec3 moment_left_of(std::span<const SphereArc> loop);

/// Returns the contribution of the steps between the arcs of a loop that does not quite close to moment_left_of().
glm::dvec3 moment_of_steps(std::span<const SphereArc> loop);

/// Returns the straight distance from a point of the unit sphere to the loop, positive if the point lies on its left.
/// All interior angles are at most pi, as in area_left_of().
double distance_left_of(const glm::dvec3& point, std::span<const SphereArc> loop);

/// True if `inner`, which may touch the loop but not cross it, lies on the left of it.
bool lies_left_of(std::span<const SphereArc> inner, std::span<const SphereArc> loop);

/// Returns the great circle around a unit axis.
inline SphereCircle great_circle(const glm::dvec3& axis) {
  const glm::dvec3 aside = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(axis, aside));
  return {axis, 0, x, glm::cross(axis, x)};
}

/// The parameters of a circle that remain after half-spaces have been cut away.
class ArcIntervals {
 public:
  void restart(double length) { kept_.assign(1, {0.0, length}); }

  /// Keeps the points p of the circle with dot(normal, p) <= offset.
  void keep(const SphereCircle& circle, const glm::dvec3& normal, double offset) {
    const double a = glm::dot(normal, circle.x), b = glm::dot(normal, circle.y), size = std::hypot(a, b);
    const double room = offset - circle.height * glm::dot(normal, circle.axis);
    if (room >= size) return;
    if (room <= -size) {
      kept_.clear();
      return;
    }
    const double middle = std::atan2(b, a), half = std::acos(room / size);
    for (const double turn : {0.0, 2 * std::numbers::pi}) remove(middle - half + turn, middle + half + turn);
  }

  const std::vector<std::pair<double, double>>& kept() const { return kept_; }

 private:
  void remove(double low, double high) {
    if (kept_.empty() || low >= kept_.back().second || high <= kept_.front().first) return;
    rest_.clear();
    for (const auto& [from, to] : kept_) {
      if (low >= to || high <= from) {
        rest_.emplace_back(from, to);
        continue;
      }
      if (low > from) rest_.emplace_back(from, low);
      if (high < to) rest_.emplace_back(high, to);
    }
    std::swap(kept_, rest_);
  }

  std::vector<std::pair<double, double>> kept_, rest_;
};

/// The range of a linear function along a circle: from `least` to `most`.
struct ArcRange {
  double least, most;
};

/// Returns the range of a linear function along a short arc from its values and slopes at both ends. Most planes
/// clearly leave all of an arc or nothing of it, and this finds out without trigonometry. `middle` is the function's
/// value at the circle's centre. The arc is shorter than half a turn, so it has at most one extremum inside.
inline ArcRange range_along(const std::array<double, 2>& value, const std::array<double, 2>& slope, double middle) {
  ArcRange range{std::min(value[0], value[1]), std::max(value[0], value[1])};
  if (slope[0] * slope[1] < 0) {
    const double swing = std::sqrt((value[0] - middle) * (value[0] - middle) + slope[0] * slope[0]);
    (slope[0] > 0 ? range.most : range.least) = slope[0] > 0 ? middle + swing : middle - swing;
  }
  return range;
}

/// Three points of a short arc from which ranges are computed: begin, middle and end, with the tangents at both ends.
struct ArcPoints {
  std::array<glm::dvec3, 3> point, onwards;

  ArcPoints(const SphereCircle& circle, const glm::dvec3& begin, const glm::dvec3& end) {
    const glm::dvec3 center = circle.height * circle.axis, both = begin + end - 2.0 * center;
    point = {begin, center + both * (glm::length(circle.x) / glm::length(both)), end};
    for (std::size_t n = 0; n < 3; ++n) onwards[n] = glm::cross(circle.axis, point[n] - center);
  }
};

}  // namespace meniscus
