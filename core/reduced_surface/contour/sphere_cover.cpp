// SPDX-License-Identifier: BSD-3-Clause
// The vertices of a twice subdivided icosahedron as watched directions; sums of angles as products of cosines.
#include "core/reduced_surface/contour/sphere_cover.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace meniscus {
namespace {

constexpr std::size_t kDirections = 162;
constexpr std::size_t kPadded = 176;  // whole vectors of 16
constexpr double kRoom = 1e-4;        // radian, for single precision

// Directions, and the largest angle from any point of the sphere to the nearest of them: the largest circumradius of a
// triangle of the subdivision.
struct WatchedDirections {
  alignas(64) std::array<float, kPadded> x{}, y{}, z{};
  double cos_angle = 1;
  double sin_angle = 0;

  WatchedDirections() {
    const double g = (1 + std::sqrt(5.0)) / 2;
    std::vector<glm::dvec3> points;
    for (const double s : {-1.0, 1.0})
      for (const double t : {-g, g}) {
        points.push_back({s, t, 0});
        points.push_back({0, s, t});
        points.push_back({t, 0, s});
      }
    for (glm::dvec3& p : points) p = glm::normalize(p);
    std::vector<std::array<std::size_t, 3>> triangles;
    for (std::size_t a = 0; a < 12; ++a)
      for (std::size_t b = a + 1; b < 12; ++b)
        for (std::size_t c = b + 1; c < 12; ++c)
          if (glm::dot(points[a], points[b]) > 0.4 && glm::dot(points[b], points[c]) > 0.4 &&
              glm::dot(points[c], points[a]) > 0.4)
            triangles.push_back({a, b, c});
    for (int level = 0; level < 2; ++level) subdivide(points, triangles);
    double smallest = 1;
    for (const auto& [a, b, c] : triangles) {
      const glm::dvec3 center = glm::normalize(glm::cross(points[b] - points[a], points[c] - points[a]));
      smallest = std::min(smallest, std::abs(glm::dot(center, points[a])));
    }
    const double angle = std::acos(smallest) + kRoom;
    cos_angle = std::cos(angle);
    sin_angle = std::sin(angle);
    for (std::size_t n = 0; n < kDirections; ++n) {
      x[n] = static_cast<float>(points[n].x);
      y[n] = static_cast<float>(points[n].y);
      z[n] = static_cast<float>(points[n].z);
    }
  }

  static void subdivide(std::vector<glm::dvec3>& points, std::vector<std::array<std::size_t, 3>>& triangles) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
    const auto middle = [&](std::size_t a, std::size_t b) {
      const auto [at, added] = middles.try_emplace(std::minmax(a, b), points.size());
      if (added) points.push_back(glm::normalize(points[a] + points[b]));
      return at->second;
    };
    std::vector<std::array<std::size_t, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
};

const WatchedDirections& watched() {
  static const WatchedDirections directions;
  return directions;
}

// Marks the directions within the cap dot(axis, direction) >= cosine. Wider vector units change nothing in the result.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
__attribute__((target_clones("avx512f", "avx2", "default")))
#endif
void mark_cap(const float* x, const float* y, const float* z, float ax, float ay, float az, float cosine,
              std::uint32_t* marks) {
  for (std::size_t n = 0; n < kPadded; ++n) marks[n] |= ax * x[n] + ay * y[n] + az * z[n] >= cosine ? 1u : 0u;
}

bool all_marked(const std::uint32_t* marks) {
  std::uint32_t all = 1;
  for (std::size_t n = 0; n < kDirections; ++n) all &= marks[n];
  return all != 0;
}

}  // namespace

UncoveredDirections uncovered_directions(const Blockers& blockers) {
  const WatchedDirections& w = watched();
  alignas(64) std::uint32_t marks[kPadded] = {};
  const double radius = std::sqrt(blockers.first_weight());
  for (std::size_t n = 0; n < blockers.size(); ++n) {
    const Blockers::Ball& b = blockers[n];
    if (!(b.distance > 1e-6)) continue;
    // The ball covers the cap of angle a, cos a = cosine; narrowed by the watched angle: cos(a - angle).
    const double cosine = b.half_power / (b.distance * radius);
    if (!(cosine < w.cos_angle) || cosine < -1) continue;
    const double narrowed = cosine * w.cos_angle + std::sqrt(1 - cosine * cosine) * w.sin_angle;
    const glm::vec3 axis(b.center / b.distance);
    mark_cap(w.x.data(), w.y.data(), w.z.data(), axis.x, axis.y, axis.z, static_cast<float>(narrowed), marks);
    if (n % 8 == 7 && all_marked(marks)) return {};
  }
  UncoveredDirections uncovered;
  for (std::size_t n = 0; n < kDirections; ++n)
    if (!marks[n]) uncovered.bits[n / 64] |= std::uint64_t{1} << (n % 64);
  return uncovered;
}

bool may_be_exposed(const UncoveredDirections& uncovered, const glm::dvec3& axis, double cosine) {
  const WatchedDirections& w = watched();
  if (!(std::abs(cosine) < 1)) return true;
  // Directions within the watched angle of the circle: cos(a + angle) <= dot <= cos(a - angle), a = acos(cosine).
  const double along = cosine * w.cos_angle, across = std::sqrt(1 - cosine * cosine) * w.sin_angle;
  const float high = cosine > w.cos_angle ? 2.0f : static_cast<float>(along + across);
  const float low = cosine < -w.cos_angle ? -2.0f : static_cast<float>(along - across);
  const glm::vec3 n(axis);
  for (std::size_t word = 0; word < 3; ++word)
    for (std::uint64_t bits = uncovered.bits[word]; bits; bits &= bits - 1) {
      const std::size_t d = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
      const float dot = n.x * w.x[d] + n.y * w.y[d] + n.z * w.z[d];
      if (dot >= low && dot <= high) return true;
    }
  return false;
}

}  // namespace meniscus
