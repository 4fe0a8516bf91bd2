// SPDX-License-Identifier: BSD-3-Clause
// Samples a sphere at the vertices of a twice subdivided icosahedron, and tests sums of angles by products of cosines.
#include "core/reduced_surface/contour/sphere_cover.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/math/vector_loops.h"

namespace meniscus {
namespace {

constexpr std::size_t kDirections = 162;
constexpr std::size_t kBlock = 16;    // directions that are tested together
constexpr std::size_t kPadded = 176;  // whole blocks
static_assert(kPadded % kBlock == 0);
constexpr double kRoom = 1e-4;  // radians, for single precision

// The directions, and the largest angle from any point of the sphere to the nearest of them: the largest circumradius
// of a triangle of the subdivision.
struct WatchedDirections {
  alignas(64) std::array<float, kPadded> x{}, y{}, z{};
  double cos_angle = 1;
  double sin_angle = 0;
  double cos_near = 1;  // cosine of an angle in the middle of the allowance for rounding

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
    cos_near = std::cos(angle - kRoom / 2);
    cluster(points);
    for (std::size_t n = 0; n < kPadded; ++n) {
      const glm::vec3 direction(points[std::min(n, kDirections - 1)]);
      x[n] = direction.x;
      y[n] = direction.y;
      z[n] = direction.z;
    }
  }

  // Orders directions so that the directions of a block are neighbours, and covered by the same few balls.
  static void cluster(std::vector<glm::dvec3>& points) {
    for (std::size_t first = 0; first < points.size(); first += kBlock) {
      const auto begin = points.begin() + static_cast<std::ptrdiff_t>(first);
      std::iter_swap(begin, std::max_element(begin, points.end(), [](auto& a, auto& b) { return a.z < b.z; }));
      std::sort(begin + 1, points.end(), [near = *begin](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::dot(near, a) > glm::dot(near, b);
      });
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

constexpr float kNowhere = 4;  // larger than any cosine: an empty cap
constexpr float kWide = 0.6f;  // caps of smaller cosine, about ten around an atom of a protein, cover most

// The number of caps, or directions, in one step. Lists are padded with entries that change nothing.
constexpr std::size_t kStep = 4;
constexpr std::size_t whole_steps(std::size_t count) { return (count + kStep - 1) / kStep * kStep; }

struct Points {
  const float *x, *y, *z;
};
struct CapColumns {
  const float *x, *y, *z, *cosine;
};
struct CircleColumns {
  float *x, *y, *z, *cosine, *low, *high;
};

// Narrows caps. A ball covers the cap of angle a, cos a = c; narrowed by the sampling angle it is cos(a - angle).
// Directions within the sampling angle of its rim have cos(a + angle) <= dot(axis, direction) <= cos(a - angle).
MENISCUS_VECTOR_CLONES
void narrow_caps(const Blockers::Columns& balls, std::size_t count, double inverse_radius, double cos_angle,
                 double sin_angle, const CircleColumns& out) {
  const Blockers::Columns b = balls;
  const CircleColumns o = out;
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < count; ++n) {
    const double inverse = 1 / b.distance[n], c = b.half_power[n] * inverse * inverse_radius;
    const double along = c * cos_angle, across = std::sqrt(1 - c * c) * sin_angle;
    const double open = c < cos_angle ? along + across : kNowhere;
    const double known = c < -1 ? kNowhere : open;
    const double low = c >= -cos_angle ? along - across : -2.0, high = c <= cos_angle ? along + across : 2.0;
    const bool has_axis = b.distance[n] > 1e-6, has_rim = has_axis & (c > -1) & (c < 1);
    o.x[n] = static_cast<float>(has_axis ? b.x[n] * inverse : 0.0);
    o.y[n] = static_cast<float>(has_axis ? b.y[n] * inverse : 0.0);
    o.z[n] = static_cast<float>(has_axis ? b.z[n] * inverse : 0.0);
    o.cosine[n] = static_cast<float>(has_axis ? known : kNowhere);
    o.low[n] = static_cast<float>(has_rim ? low : -2.0);
    o.high[n] = static_cast<float>(has_rim ? high : 2.0);
  }
}

std::int32_t sign_bits(float number) { return std::bit_cast<std::int32_t>(number); }

// Computes, for each direction, in whole blocks, a number that is negative if no cap contains it: the sign bits of
// dot(axis, direction) - cosine, combined. Each step takes several caps, because the results of a block go through
// memory.
MENISCUS_VECTOR_CLONES
void sign_outside(const Points& directions, std::size_t count, const CapColumns& caps, std::size_t cap_count,
                  std::int32_t* sign) {
  const CapColumns c = caps;
  for (std::size_t first = 0; first < count; first += kBlock) {
    const float *x = directions.x + first, *y = directions.y + first, *z = directions.z + first;
    std::int32_t* outside = sign + first;
    for (std::size_t l = 0; l < kBlock; ++l) outside[l] = -1;
    for (std::size_t n = 0; n < cap_count; n += kStep) {
      const float x0 = c.x[n], y0 = c.y[n], z0 = c.z[n], cosine0 = c.cosine[n];
      const float x1 = c.x[n + 1], y1 = c.y[n + 1], z1 = c.z[n + 1], cosine1 = c.cosine[n + 1];
      const float x2 = c.x[n + 2], y2 = c.y[n + 2], z2 = c.z[n + 2], cosine2 = c.cosine[n + 2];
      const float x3 = c.x[n + 3], y3 = c.y[n + 3], z3 = c.z[n + 3], cosine3 = c.cosine[n + 3];
      std::int32_t any = 0;
      MENISCUS_INDEPENDENT_STEPS
      for (std::size_t l = 0; l < kBlock; ++l) {
        const std::int32_t outside0 = sign_bits(x0 * x[l] + y0 * y[l] + z0 * z[l] - cosine0);
        const std::int32_t outside1 = sign_bits(x1 * x[l] + y1 * y[l] + z1 * z[l] - cosine1);
        const std::int32_t outside2 = sign_bits(x2 * x[l] + y2 * y[l] + z2 * z[l] - cosine2);
        const std::int32_t outside3 = sign_bits(x3 * x[l] + y3 * y[l] + z3 * z[l] - cosine3);
        outside[l] &= outside0 & outside1 & (outside2 & outside3);
        any |= outside[l];
      }
      if (any >= 0) break;
    }
  }
}

// Computes, for each circle, in whole blocks, a number that is negative if no direction is near it.
MENISCUS_VECTOR_CLONES
void sign_far(const CircleColumns& circles, std::size_t count, const Points& directions, std::size_t direction_count,
              std::int32_t* sign) {
  const Points d = directions;
  for (std::size_t first = 0; first < count; first += kBlock) {
    const float *x = circles.x + first, *y = circles.y + first, *z = circles.z + first;
    const float *low = circles.low + first, *high = circles.high + first;
    std::int32_t* far = sign + first;
    for (std::size_t l = 0; l < kBlock; ++l) far[l] = -1;
    for (std::size_t n = 0; n < direction_count; n += kStep) {
      const float x0 = d.x[n], y0 = d.y[n], z0 = d.z[n], x1 = d.x[n + 1], y1 = d.y[n + 1], z1 = d.z[n + 1];
      const float x2 = d.x[n + 2], y2 = d.y[n + 2], z2 = d.z[n + 2], x3 = d.x[n + 3], y3 = d.y[n + 3], z3 = d.z[n + 3];
      std::int32_t any = 0;
      MENISCUS_INDEPENDENT_STEPS
      for (std::size_t l = 0; l < kBlock; ++l) {
        const float dot0 = x[l] * x0 + y[l] * y0 + z[l] * z0, dot1 = x[l] * x1 + y[l] * y1 + z[l] * z1;
        const float dot2 = x[l] * x2 + y[l] * y2 + z[l] * z2, dot3 = x[l] * x3 + y[l] * y3 + z[l] * z3;
        const std::int32_t far0 = sign_bits(dot0 - low[l]) | sign_bits(high[l] - dot0);
        const std::int32_t far1 = sign_bits(dot1 - low[l]) | sign_bits(high[l] - dot1);
        const std::int32_t far2 = sign_bits(dot2 - low[l]) | sign_bits(high[l] - dot2);
        const std::int32_t far3 = sign_bits(dot3 - low[l]) | sign_bits(high[l] - dot3);
        far[l] &= far0 & far1 & (far2 & far3);
        any |= far[l];
      }
      if (any >= 0) break;
    }
  }
}

constexpr std::size_t whole_blocks(std::size_t count) { return (count + kBlock - 1) / kBlock * kBlock; }

}  // namespace

template <std::size_t kColumns>
void SphereCover::Rows<kColumns>::make_room(std::size_t count) {
  if (count <= columns[0].size()) return;
  for (std::vector<float>& column : columns) column.resize(2 * count);
}

// Lists the caps that cover something, the wide ones first: the others do not matter where these cover all.
void SphereCover::list_caps(std::size_t count) {
  caps_.make_room(count + kStep);
  const float *x = circles_.column(0), *y = circles_.column(1), *z = circles_.column(2), *cosine = circles_.column(3);
  float *to_x = caps_.column(0), *to_y = caps_.column(1), *to_z = caps_.column(2), *to_cosine = caps_.column(3);
  std::uint32_t* past = listed_.data();
  const auto append_between = [&](float low, float high) {
    for (std::size_t n = 0; n < count; ++n) signs_[n] = ((cosine[n] >= low) & (cosine[n] < high)) ? -1 : 0;
    past = list_negative(signs_.data(), count, 0, past);
    return static_cast<std::size_t>(past - listed_.data());
  };
  wide_count_ = append_between(-2, kWide);
  const std::size_t kept = append_between(kWide, kNowhere);
  for (std::size_t n = 0; n < kept; ++n) {
    const std::uint32_t circle = listed_[n];
    to_x[n] = x[circle];
    to_y[n] = y[circle];
    to_z[n] = z[circle];
    to_cosine[n] = cosine[circle];
  }
  cap_count_ = whole_steps(kept);
  std::fill(to_cosine + kept, to_cosine + cap_count_, kNowhere);
  wide_count_ = std::min(whole_steps(wide_count_), cap_count_);
}

// Keeps the directions with a negative sign. They may be in the list already, because none moves to a later place.
void SphereCover::list_uncovered(const float* x, const float* y, const float* z, std::size_t count) {
  float *to_x = uncovered_.column(0), *to_y = uncovered_.column(1), *to_z = uncovered_.column(2);
  const std::uint32_t* past = list_negative(signs_.data(), count, 0, listed_.data());
  uncovered_count_ = static_cast<std::size_t>(past - listed_.data());
  for (std::size_t n = 0; n < uncovered_count_; ++n) {
    const std::uint32_t direction = listed_[n];
    uncovered_numbers_[n] = uncovered_numbers_[direction];
    to_x[n] = x[direction];
    to_y[n] = y[direction];
    to_z[n] = z[direction];
  }
}

template <std::size_t kColumns>
void SphereCover::Rows<kColumns>::repeat_last(std::size_t count, std::size_t past) {
  for (std::vector<float>& column : columns)
    for (std::size_t n = count; n < past; ++n) column[n] = column[count - 1];
}

bool SphereCover::is_near(const glm::dvec3& point, std::span<const std::uint8_t> uncovered) {
  const WatchedDirections& w = watched();
  double nearest = -1;
  for (const std::uint8_t n : uncovered)
    nearest = std::max(nearest, point.x * w.x[n] + point.y * w.y[n] + point.z * w.z[n]);
  return nearest > w.cos_near;
}

bool SphereCover::test(const Blockers& blockers) {
  const WatchedDirections& w = watched();
  const std::size_t count = blockers.size(), room = whole_blocks(count);
  circles_.make_room(room);
  uncovered_.make_room(kPadded);
  if (signs_.size() < std::max(room, kPadded)) {
    signs_.resize(2 * std::max(room, kPadded));
    listed_.resize(signs_.size() + kLanes);
  }
  const auto of = [&](std::size_t c) { return circles_.column(c); };
  const CircleColumns circles{of(0), of(1), of(2), of(3), of(4), of(5)};
  narrow_caps(blockers.columns(), whole_vectors(count), 1 / std::sqrt(blockers.first_weight()), w.cos_angle,
              w.sin_angle, circles);
  list_caps(count);
  const auto cap = [&](std::size_t c) { return caps_.column(c); };
  sign_outside({w.x.data(), w.y.data(), w.z.data()}, kPadded, {cap(0), cap(1), cap(2), cap(3)}, wide_count_,
               signs_.data());
  uncovered_numbers_.resize(kDirections);
  std::iota(uncovered_numbers_.begin(), uncovered_numbers_.end(), std::uint8_t{0});
  list_uncovered(w.x.data(), w.y.data(), w.z.data(), kDirections);
  const Points left{uncovered_.column(0), uncovered_.column(1), uncovered_.column(2)};
  sign_outside(left, whole_blocks(uncovered_count_),
               {cap(0) + wide_count_, cap(1) + wide_count_, cap(2) + wide_count_, cap(3) + wide_count_},
               cap_count_ - wide_count_, signs_.data());
  list_uncovered(left.x, left.y, left.z, uncovered_count_);
  if (uncovered_count_ == 0) return false;
  uncovered_.repeat_last(uncovered_count_, whole_steps(uncovered_count_));
  sign_far(circles, room, left, whole_steps(uncovered_count_), signs_.data());
  return true;
}

}  // namespace meniscus
