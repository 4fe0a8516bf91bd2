// SPDX-License-Identifier: BSD-3-Clause
// The vertices of a twice subdivided icosahedron as watched directions; sums of angles as products of cosines.
#include "core/reduced_surface/contour/sphere_cover.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/math/vector_clones.h"

namespace meniscus {
namespace {

constexpr std::size_t kDirections = 162;
constexpr std::size_t kBlock = 16;    // directions that are looked at together
constexpr std::size_t kPadded = 176;  // whole blocks
static_assert(kPadded % kBlock == 0);
constexpr double kRoom = 1e-4;  // radian, for single precision

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
    cluster(points);
    for (std::size_t n = 0; n < kPadded; ++n) {
      const glm::vec3 direction(points[std::min(n, kDirections - 1)]);
      x[n] = direction.x;
      y[n] = direction.y;
      z[n] = direction.z;
    }
  }

  // So orders directions that those of a block are neighbours, and covered by the same few balls.
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

constexpr float kNowhere = 4;  // no cosine is as large: an empty cap

// A ball covers the cap of angle a, cos a = cosine; narrowed by the watched angle: cos(a - angle).
MENISCUS_VECTOR_CLONES
void narrow_caps(const Blockers::Columns& balls, std::size_t count, double inverse_radius, double cos_angle,
                 double sin_angle, float* x, float* y, float* z, float* cosine) {
  const Blockers::Columns b = balls;
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < count; ++n) {
    const double inverse = 1 / b.distance[n], c = b.half_power[n] * inverse * inverse_radius;
    const double narrowed = c * cos_angle + std::sqrt(1 - c * c) * sin_angle;
    const double open = c < cos_angle ? narrowed : kNowhere;
    const double known = c < -1 ? kNowhere : open;
    const bool has_axis = b.distance[n] > 1e-6;
    x[n] = static_cast<float>(has_axis ? b.x[n] * inverse : 0.0);
    y[n] = static_cast<float>(has_axis ? b.y[n] * inverse : 0.0);
    z[n] = static_cast<float>(has_axis ? b.z[n] * inverse : 0.0);
    cosine[n] = static_cast<float>(has_axis ? known : kNowhere);
  }
}

template <typename Bits>
bool any_negative(const Bits& bits) {
  std::uint64_t pairs[sizeof(Bits) / 8], all = 0;
  std::memcpy(pairs, &bits, sizeof bits);
  for (const std::uint64_t pair : pairs) all |= pair;
  return (all & 0x8000000080000000u) != 0;
}

// Of each direction a number that is negative if no cap holds it: the sign bits of dot(axis, direction) - cosine, all
// in one. For want of anything but sums, products and bits the loop needs no comparison of vectors.
MENISCUS_VECTOR_CLONES
void sign_outside(const WatchedDirections& w, const Caps& caps, std::size_t count, std::int32_t* sign) {
  typedef float Floats __attribute__((vector_size(kBlock * sizeof(float))));
  typedef std::int32_t Bits __attribute__((vector_size(kBlock * sizeof(std::int32_t))));
  const float *ax = caps.column(0), *ay = caps.column(1), *az = caps.column(2), *cosine = caps.column(3);
  for (std::size_t first = 0; first < kPadded; first += kBlock) {
    Floats x, y, z;
    std::memcpy(&x, w.x.data() + first, sizeof x);
    std::memcpy(&y, w.y.data() + first, sizeof y);
    std::memcpy(&z, w.z.data() + first, sizeof z);
    Bits outside = ~Bits{};
    for (std::size_t n = 0; n < count; ++n) {
      outside &= reinterpret_cast<Bits>(ax[n] * x + ay[n] * y + az[n] * z - cosine[n]);
      if (n % 4 == 3 && !any_negative(outside)) break;
    }
    std::memcpy(sign + first, &outside, sizeof outside);
  }
}

// Dot products with the axis of a circle of the directions within the watched angle of it.
struct Band {
  float low, high;
};

Band band_around(double cosine) {
  // cos(a + angle) <= dot <= cos(a - angle), a = acos(cosine).
  const WatchedDirections& w = watched();
  const double along = cosine * w.cos_angle, across = std::sqrt(1 - cosine * cosine) * w.sin_angle;
  return {cosine < -w.cos_angle ? -2.0f : static_cast<float>(along - across),
          cosine > w.cos_angle ? 2.0f : static_cast<float>(along + across)};
}

MENISCUS_VECTOR_CLONES
bool any_in_band(const float* x, const float* y, const float* z, std::size_t count, float ax, float ay, float az,
                 Band band) {
  for (std::size_t first = 0; first < count; first += kBlock) {
    std::uint32_t any = 0;
    for (std::size_t n = first; n < first + kBlock; ++n) {
      const float dot = ax * x[n] + ay * y[n] + az * z[n];
      const std::uint32_t above = dot >= band.low ? 1 : 0, below = dot <= band.high ? 1 : 0;
      any |= above & below;
    }
    if (any) return true;
  }
  return false;
}

}  // namespace

void Caps::make_room(std::size_t count) {
  for (std::vector<float>& column : columns)
    if (column.size() < count) column.resize(count);
}

void Caps::widest_first(std::size_t count) {
  constexpr float kWide = 0.45f;
  std::size_t wide = 0;
  for (std::size_t n = 0; n < count; ++n) {
    if (!(columns[3][n] < kWide)) continue;
    for (std::vector<float>& column : columns) std::swap(column[wide], column[n]);
    ++wide;
  }
}

UncoveredDirections uncovered_directions(const Blockers& blockers, Caps& caps) {
  const WatchedDirections& w = watched();
  caps.make_room(whole_vectors(blockers.size()));
  narrow_caps(blockers.columns(), whole_vectors(blockers.size()), 1 / std::sqrt(blockers.first_weight()), w.cos_angle,
              w.sin_angle, caps.columns[0].data(), caps.columns[1].data(), caps.columns[2].data(),
              caps.columns[3].data());
  caps.widest_first(blockers.size());
  std::array<std::int32_t, kPadded> sign;
  sign_outside(w, caps, blockers.size(), sign.data());
  UncoveredDirections uncovered;
  for (std::size_t n = 0; n < kDirections; ++n) uncovered.bits[n / 64] |= std::uint64_t{sign[n] < 0} << (n % 64);
  return uncovered;
}

bool may_be_exposed(const UncoveredDirections& uncovered, const glm::dvec3& axis, double cosine) {
  if (!(std::abs(cosine) < 1)) return true;
  const WatchedDirections& w = watched();
  const Band band = band_around(cosine);
  const glm::vec3 n(axis);
  for (std::size_t word = 0; word < uncovered.bits.size(); ++word)
    for (std::uint64_t bits = uncovered.bits[word]; bits; bits &= bits - 1) {
      const std::size_t d = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
      const float dot = n.x * w.x[d] + n.y * w.y[d] + n.z * w.z[d];
      if (dot >= band.low && dot <= band.high) return true;
    }
  return false;
}

void WatchedList::assign(const UncoveredDirections& uncovered) {
  static_assert(kMost == kPadded);
  const WatchedDirections& w = watched();
  std::size_t count = 0;
  for (std::size_t word = 0; word < uncovered.bits.size(); ++word)
    for (std::uint64_t bits = uncovered.bits[word]; bits; bits &= bits - 1) {
      const std::size_t d = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
      x_[count] = w.x[d];
      y_[count] = w.y[d];
      z_[count++] = w.z[d];
    }
  // Whole vectors of what is in the list anyhow.
  for (count_ = count; count_ % kBlock != 0; ++count_) {
    x_[count_] = x_[count - 1];
    y_[count_] = y_[count - 1];
    z_[count_] = z_[count - 1];
  }
}

bool WatchedList::may_be_exposed(const glm::dvec3& axis, double cosine) const {
  if (!(std::abs(cosine) < 1)) return true;
  const glm::vec3 n(axis);
  return any_in_band(x_.data(), y_.data(), z_.data(), count_, n.x, n.y, n.z, band_around(cosine));
}

}  // namespace meniscus
