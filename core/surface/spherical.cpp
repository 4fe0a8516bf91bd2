// SPDX-License-Identifier: BSD-3-Clause
// Closed forms on the sphere: Gauss-Bonnet areas, boundary moments, and a crossing test for points and loops.
#include "core/surface/spherical.h"

#include "core/surface/walks.h"

namespace meniscus {
namespace {

glm::dvec3 rotated(const SphereArc& arc, double angle) {
  const glm::dvec3 along = arc.axis * arc.height;
  const glm::dvec3 e = arc.from - along;
  return along + std::cos(angle) * e + std::sin(angle) * glm::cross(arc.axis, e);
}

// Returns the unit tangent of the walk at a point of the arc.
glm::dvec3 tangent(const SphereArc& arc, const glm::dvec3& point) {
  const glm::dvec3 t = glm::cross(arc.axis, point);
  const double length = glm::length(t);
  return length > 0 ? t * ((arc.clockwise() ? -1.0 : 1.0) / length) : t;
}

// Returns the point of the arc's whole circle that is nearest to a point of the sphere.
glm::dvec3 nearest_of_circle(const SphereArc& arc, const glm::dvec3& point) {
  const glm::dvec3 flat = point - arc.axis * glm::dot(arc.axis, point);
  const double length = glm::length(flat);
  if (!(length > 0)) return arc.from;
  return arc.axis * arc.height + flat * (std::sqrt(std::max(0.0, 1 - arc.height * arc.height)) / length);
}

// True if a point of the arc's whole circle comes before the arc's end. The signs of two areas decide, unless one area
// is almost zero: then the angle decides.
bool on_sweep(const SphereArc& arc, const glm::dvec3& point) {
  constexpr double kClear = 1e-9;         // relative to the squared radius
  constexpr double kLargeEnough = 1e-10;  // squared radius above which rounding is smaller than that
  const glm::dvec3 e = arc.from - arc.axis * arc.height, f = point - arc.axis * arc.height;
  const double turn = arc.clockwise() ? -1 : 1;
  const double past_begin = turn * glm::dot(arc.axis, glm::cross(e, f));
  if (const double squared = glm::dot(e, e); squared > kLargeEnough) {
    const glm::dvec3 g = arc.to - arc.axis * arc.height;
    const double before_end = turn * glm::dot(arc.axis, glm::cross(f, g)), clear = kClear * squared;
    if (std::abs(past_begin) > clear && std::abs(before_end) > clear) {
      const bool past = past_begin > 0, before = before_end > 0;
      return std::abs(arc.sweep) < std::numbers::pi ? past && before : past || before;
    }
  }
  double angle = std::atan2(past_begin, glm::dot(e, f));
  if (angle < 0) angle += 2 * std::numbers::pi;
  return angle < std::abs(arc.sweep);
}

// The parts of distance_left_of(): the cosine of the distance, and the side.
struct Side {
  double nearest;
  bool left;
  double distance() const { return std::sqrt(std::max(0.0, 2 - 2 * nearest)); }
};

Side side_of_loop(const glm::dvec3& point, std::span<const SphereArc> loop) {
  // The great circle from the point to the loop's nearest point meets the loop nowhere before, so it arrives on the
  // point's own side. No path has to avoid corners, so symmetry does no harm.
  Side side{-2, false};
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const SphereArc& arc = loop[n];
    const glm::dvec3 on_arc = nearest_of_circle(arc, point);
    if (const double cosine = glm::dot(on_arc, point); cosine > side.nearest && (arc.whole || on_sweep(arc, on_arc)))
      side = {cosine, (glm::dot(arc.axis, point) > arc.height) == !arc.clockwise()};
    if (arc.whole) continue;
    if (const double cosine = glm::dot(arc.to, point); cosine > side.nearest) {
      const glm::dvec3 in = tangent(arc, arc.to), out = tangent(loop[n + 1 == loop.size() ? 0 : n + 1], arc.to);
      // The direction half-way into the corner, for any interior angle from 0 to pi.
      const glm::dvec3 inwards = out - in + glm::cross(arc.to, out + in);
      side = {cosine, glm::dot(inwards, point - arc.to) > 0};
    }
  }
  return side;
}

}  // namespace

SphereArc sphere_arc(const Border& border, bool backwards, const glm::dvec3& center, double radius) {
  SphereArc arc;
  arc.axis = border.axis;
  arc.height = glm::dot(border.center - center, border.axis) / radius;
  const double ratio = border.radius / radius;
  const glm::dvec3 along = arc.axis * arc.height;
  const glm::dvec3 first = along + ratio * border.start;
  const glm::dvec3 last = along + ratio * arc_direction(border, border.sweep);
  arc.from = backwards ? last : first;
  arc.to = backwards ? first : last;
  arc.sweep = backwards ? -border.sweep : border.sweep;
  arc.whole = border.vertex[0] == kNone;
  return arc;
}

void walk_loop(const Surface& surface, const Loop& loop, const glm::dvec3& center, double radius, bool seen_from_inside,
               std::vector<SphereArc>& arcs) {
  arcs.clear();
  for (std::size_t n = loop.first_half_border, past = n + loop.half_border_count; n < past; ++n) {
    prefetch_border(surface, n + kPrefetchAhead);
    const HalfBorder half = surface.half_borders[n];
    arcs.push_back(
        sphere_arc(surface.borders[border_of(half)], is_backwards(half) != seen_from_inside, center, radius));
  }
  if (seen_from_inside) std::reverse(arcs.begin(), arcs.end());
}

double area_left_of(std::span<const SphereArc> loop) {
  // The curvature of a circle at height h, walked counter-clockwise, integrates to h times the angle.
  if (loop.size() == 1 && loop[0].whole)
    return 2 * std::numbers::pi * (1 - std::clamp(loop[0].height, -1.0, 1.0) * (loop[0].clockwise() ? -1 : 1));
  double turning = 0;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const SphereArc& arc = loop[n];
    turning += arc.height * arc.sweep;
    const SphereArc& next = loop[n + 1 == loop.size() ? 0 : n + 1];
    const glm::dvec3 in = tangent(arc, arc.to), out = tangent(next, next.from);
    double exterior = std::atan2(glm::dot(arc.to, glm::cross(in, out)), glm::dot(in, out));
    if (exterior < -0.5 * std::numbers::pi)
      exterior += 2 * std::numbers::pi;  // patches are convex at their corners: no interior angle over pi
    turning += exterior;
  }
  return 2 * std::numbers::pi - turning;
}

double misfit_of(std::span<const SphereArc> loop) {
  if (loop.size() == 1 && loop[0].whole) return 0;
  double worst = 0;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const SphereArc &arc = loop[n], &next = loop[n + 1 == loop.size() ? 0 : n + 1];
    const glm::dvec3 step = next.from - arc.to;
    const double height = std::max(std::abs(arc.height), std::abs(next.height));
    worst = std::max(worst, glm::dot(step, step) / std::max(1 - height * height, 1e-300));
  }
  return std::sqrt(worst);
}

double shortest_of(std::span<const SphereArc> loop) {
  double shortest = 1;
  for (const SphereArc& arc : loop)
    if (!arc.whole)
      shortest = std::min(shortest, std::abs(arc.sweep) * std::sqrt(std::max(0.0, 1 - arc.height * arc.height)));
  return shortest;
}

SphereCircle circle_of(const SphereArc& arc) {
  const double sign = arc.clockwise() ? -1 : 1;
  const glm::dvec3 x = arc.from - arc.height * arc.axis;
  return {sign * arc.axis, sign * arc.height, x, sign * glm::cross(arc.axis, x)};
}

double area_swept_from(const glm::dvec3& pole, const SphereCircle& circle, double from, double to) {
  // With alpha = dot(pole, axis) the integrand is -h + (h + alpha) / (1 + h alpha + B cos(t - t0)).
  const double alpha = glm::dot(pole, circle.axis), a = 1 + circle.height * alpha;
  const double u = glm::dot(pole, circle.x), v = glm::dot(pole, circle.y), b = std::hypot(u, v), t0 = std::atan2(v, u);
  const double slope = std::abs(circle.height + alpha);  // squared: a^2 - b^2
  const auto angle = [&](double t) {
    const double half = 0.5 * (t - t0);
    // The same quadrant as `half`, and as many turns.
    const double beyond = std::atan2(slope * std::sin(half), (a + b) * std::cos(half)) - half;
    return half + (std::abs(beyond) < 3 ? beyond : std::remainder(beyond, 2 * std::numbers::pi));
  };
  return -circle.height * (to - from) + std::copysign(2.0, circle.height + alpha) * (angle(to) - angle(from));
}

double area_swept_from(const glm::dvec3& pole, std::span<const SphereArc> loop) {
  double area = 0;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const SphereArc &arc = loop[n], &next = loop[n + 1 == loop.size() ? 0 : n + 1];
    area += area_swept_from(pole, circle_of(arc), 0.0, std::abs(arc.sweep));
    // (1 - cos theta) d phi is dot(pole, u x du) / (1 + cos theta).
    if (const double beyond = 1 + glm::dot(pole, arc.to); !arc.whole && beyond > 0)
      area += glm::dot(pole, glm::cross(arc.to, next.from)) / beyond;
  }
  return area;
}

glm::dvec3 moment_left_of(std::span<const SphereArc> loop) {
  glm::dvec3 sum(0.0);
  for (const SphereArc& arc : loop)
    sum +=
        arc.height * glm::cross(arc.axis, arc.to - arc.from) + arc.axis * ((1 - arc.height * arc.height) * arc.sweep);
  return 0.5 * sum;
}

glm::dvec3 moment_of_steps(std::span<const SphereArc> loop) {
  glm::dvec3 sum(0.0);
  for (std::size_t n = 0; n < loop.size(); ++n)
    if (!loop[n].whole) sum += 0.5 * glm::cross(loop[n].to, loop[n + 1 == loop.size() ? 0 : n + 1].from);
  return sum;
}

bool lies_left_of(std::span<const SphereArc> inner, std::span<const SphereArc> loop) {
  constexpr double kClear = 0.01;  // far beyond rounding, so that no further point is tried
  double clearest = 0;
  double nearest = std::numeric_limits<double>::infinity();  // cosine of the distance of the clearest point
  bool left = false;
  // True if the point is as near to a corner of the loop as the clearest point is to the whole loop, so not clearer.
  const auto near_corner = [&](const glm::dvec3& point) {
    return std::ranges::any_of(loop,
                               [&](const SphereArc& arc) { return !arc.whole && glm::dot(arc.to, point) >= nearest; });
  };
  for (const SphereArc& arc : inner)
    for (const double part : {0.5, 0.2, 0.8}) {
      const glm::dvec3 point = rotated(arc, part * arc.sweep);
      if (near_corner(point)) continue;
      const Side side = side_of_loop(point, loop);
      if (const double distance = side.distance(); distance > clearest) {
        clearest = distance;
        nearest = side.nearest;
        left = side.left;
        if (clearest > kClear) return left;
      }
    }
  return left;
}

double distance_left_of(const glm::dvec3& point, std::span<const SphereArc> loop) {
  const Side side = side_of_loop(point, loop);
  return side.left ? side.distance() : -side.distance();
}

}  // namespace meniscus
