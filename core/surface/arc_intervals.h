// SPDX-License-Identifier: BSD-3-Clause
// Arcs of circles on a sphere that half-spaces leave, and the ranges of linear functions along arcs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/surface/spherical.h"

namespace meniscus {

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
