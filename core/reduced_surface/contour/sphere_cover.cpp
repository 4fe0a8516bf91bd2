// SPDX-License-Identifier: BSD-3-Clause
// Samples a sphere at the vertices of a subdivided icosahedron, and tests sums of angles by products of cosines, in
// whole numbers.
#include "core/reduced_surface/contour/blockers.h"

#include <cassert>
#include <numbers>

#include <glm/common.hpp>

#include "core/math/vector_loops.h"

namespace meniscus {
namespace {

constexpr std::size_t kDirections = 252;
constexpr std::size_t kPadded = SphereCover::kPadded;
constexpr std::size_t kBlock = 32;  // directions that are tested together
static_assert(kPadded % kBlock == 0);
constexpr double kRoom = 1e-4;  // radians, for rounding in double and single precision

// Axes of caps and directions are vectors of whole numbers of 16 bits, because vector units multiply the most of these
// at once. An axis of a cap is rounded to the length kAxisLength, by half a unit in each number. A direction has
// exactly the stored numbers, and a length within kLengthError of kLength.
constexpr float kAxisLength = 256, kLength = 127, kLengthError = 0.25f;
constexpr float kProduct = kAxisLength * kLength;  // the dot product of an axis and the same direction
// A bound on the difference of a dot product from kProduct times the cosine. The axis is off by 0.87 units, the length
// of the direction by kLengthError. The last term is for the numbers that products are compared to: they are rounded,
// and near a cosine of 1 a root in single precision is off by as much as three units.
constexpr float kProductError = 0.9f * (kLength + kLengthError) + kAxisLength * kLengthError + 5;
constexpr float kBeyond = 1.002f;  // replaces a cosine: the number to compare to is larger than any product
static_assert(kBeyond * kProduct + kProductError < 0x7fff);
static_assert(kBeyond * kProduct + kProductError - 1 > (kAxisLength + 0.9f) * (kLength + kLengthError));

constexpr std::size_t kFew = 5;     // the largest number of directions around which it pays to look closer
constexpr std::size_t kLooks = 3;   // the number of closer looks, each at smaller angles
constexpr std::size_t kAround = 7;  // the number of new directions around a direction

// The directions, and the largest angle from any point of the sphere to the nearest of them: the largest circumradius
// of a triangle between them.
struct WatchedDirections {
  alignas(64) std::array<std::int16_t, kPadded> x{}, y{}, z{};
  std::array<glm::dvec3, kDirections> unit{};
  double cos_angle = 1;
  double sin_angle = 0;
  // A closer look replaces a direction by itself and those around it: the angle between them, and the largest angle
  // from any point near the direction to the nearest of them.
  struct Look {
    double cos_out, sin_out, cos_angle, sin_angle;
  };
  std::array<Look, kLooks> looks{};
  std::array<glm::dvec2, kAround> turns{};
  double cos_near = 1;  // cosine of an angle in the middle of the allowance for rounding

  WatchedDirections() {
    const double g = (1 + std::sqrt(5.0)) / 2;
    std::vector<glm::dvec3> corners, points;
    for (const double s : {-1.0, 1.0})
      for (const double t : {-g, g}) {
        corners.push_back(glm::normalize(glm::dvec3(s, t, 0)));
        corners.push_back(glm::normalize(glm::dvec3(0, s, t)));
        corners.push_back(glm::normalize(glm::dvec3(t, 0, s)));
      }
    double smallest = 1;
    for (std::size_t a = 0; a < 12; ++a)
      for (std::size_t b = a + 1; b < 12; ++b)
        for (std::size_t c = b + 1; c < 12; ++c)
          if (glm::dot(corners[a], corners[b]) > 0.4 && glm::dot(corners[b], corners[c]) > 0.4 &&
              glm::dot(corners[c], corners[a]) > 0.4)
            smallest = std::min(smallest, divide(corners[a], corners[b], corners[c], points));
    std::ranges::sort(points, {}, [](const glm::dvec3& p) { return std::array{p.x, p.y, p.z}; });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    assert(points.size() == kDirections);
    double angle = std::acos(smallest) + kRoom;
    cos_angle = std::cos(angle);
    sin_angle = std::sin(angle);
    cos_near = std::cos(angle - kRoom / 2);
    cluster(points);
    for (std::size_t n = 0; n < kPadded; ++n) {
      const glm::dvec3& direction = points[std::min(n, kDirections - 1)];
      x[n] = static_cast<std::int16_t>(direction.x);
      y[n] = static_cast<std::int16_t>(direction.y);
      z[n] = static_cast<std::int16_t>(direction.z);
      if (n < kDirections) unit[n] = glm::normalize(direction);
    }
    constexpr double kTurn = 2 * std::numbers::pi / kAround;
    for (std::size_t k = 0; k < kAround; ++k) {
      const double at = kTurn * static_cast<double>(k);
      turns[k] = {std::cos(at), std::sin(at)};
    }
    for (Look& look : looks) {
      // Eight caps of 0.445 times the angle of a cap cover it, one of them in its middle.
      const double middle = 0.445 * angle, out = 0.802 * angle;
      const auto to_corner = [&](double far) {
        return std::cos(out) * std::cos(far) + std::sin(out) * std::sin(far) * std::cos(kTurn / 2);
      };
      angle = std::acos(std::min({std::cos(middle), to_corner(middle), to_corner(angle)})) + kRoom;
      look = {std::cos(out), std::sin(out), std::cos(angle), std::sin(angle)};
    }
  }

  // Appends the directions in a triangle of the sphere, which are the corners of smaller triangles, five along each
  // side. Returns the cosine of the largest circumradius of these.
  static double divide(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, std::vector<glm::dvec3>& points) {
    constexpr std::size_t kSide = 5;
    const double arc = std::acos(glm::dot(a, b)) / kSide;
    // The steps on the sides are equal.
    const auto part = [&](std::size_t n) { return std::sin(static_cast<double>(n) * arc); };
    std::array<std::array<glm::dvec3, kSide + 1>, kSide + 1> at;
    for (std::size_t i = 0; i <= kSide; ++i)
      for (std::size_t j = 0; i + j <= kSide; ++j)
        points.push_back(at[i][j] = rounded(glm::normalize(part(i) * a + part(j) * b + part(kSide - i - j) * c)));
    double smallest = 1;
    const auto measure = [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
      const glm::dvec3 u = glm::normalize(p), v = glm::normalize(q), w = glm::normalize(r);
      smallest = std::min(smallest, std::abs(glm::dot(glm::normalize(glm::cross(v - u, w - u)), u)));
    };
    for (std::size_t i = 0; i < kSide; ++i)
      for (std::size_t j = 0; i + j < kSide; ++j) {
        measure(at[i][j], at[i + 1][j], at[i][j + 1]);
        if (i + j + 1 < kSide) measure(at[i + 1][j], at[i + 1][j + 1], at[i][j + 1]);
      }
    return smallest;
  }

  // Returns the vector of whole numbers nearest to a direction among those near it that have the right length.
  static glm::dvec3 rounded(const glm::dvec3& direction) {
    const glm::dvec3 near = glm::round(double{kLength} * direction);
    glm::dvec3 best(0);
    double cosine = -1;
    for (int n = 0; n < 27; ++n) {
      const glm::dvec3 p = near + glm::dvec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      const double length = glm::length(p), along = glm::dot(p, direction) / length;
      if (std::abs(length - kLength) > kLengthError || along < cosine) continue;
      best = p;
      cosine = along;
    }
    return best;
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
};

const WatchedDirections& watched() {
  static const WatchedDirections directions;
  return directions;
}

constexpr double kWide = 0.8;  // caps of smaller cosine, about twelve around an atom of a protein, cover most

// The number of caps, or directions, in one step. Lists are padded with entries that change nothing.
constexpr std::size_t kStep = 4;
constexpr std::size_t whole_steps(std::size_t count) { return (count + kStep - 1) / kStep * kStep; }

// The number of circles that are tested together.
constexpr std::size_t kCircles = 16;
constexpr std::size_t whole_blocks(std::size_t count) { return (count + kCircles - 1) / kCircles * kCircles; }

struct Points {
  const std::int16_t *x, *y, *z;
};
// Axes of caps, and limits of products of these with directions. A direction is surely in the narrowed cap from
// `limit` on, and may be near the circle from `low` to `limit`.
struct Caps {
  const std::int16_t *x, *y, *z, *limit, *low;
};

// Narrows caps. A ball covers the cap of angle a, cos a = c; narrowed by the sampling angle it is cos(a - angle).
// Directions within the sampling angle of its rim have cos(a + angle) <= dot(axis, direction) <= cos(a - angle).
// out: five columns of `room` numbers each, the members of Caps; scratch: as many numbers.
MENISCUS_VECTOR_CLONES
void narrow_caps(const Blockers::Columns& balls, std::size_t count, float inverse_radius, float cos_angle,
                 float sin_angle, std::int32_t* scratch, std::int16_t* out, std::size_t room) {
  const Blockers::Columns b = balls;
  std::int32_t *x = scratch, *y = x + room, *z = y + room, *limit = z + room, *least = limit + room;
  // Conversion cuts digits off, so the numbers that it gets are positive, and half a unit larger to be rounded.
  constexpr float kShift = 0x10000p0f + 0.5f;
  const auto whole = [](float number) { return static_cast<std::int32_t>(number + kShift) - 0x10000; };
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < count; ++n) {
    const float distance = static_cast<float>(b.distance[n]), inverse = 1 / distance;
    const float c = static_cast<float>(b.half_power[n]) * inverse * inverse_radius;
    const float along = c * cos_angle, across = std::sqrt(1 - c * c) * sin_angle;
    const float open = c < cos_angle ? along + across : kBeyond;
    const float known = c < -1 ? kBeyond : open;
    const float low = c >= -cos_angle ? along - across : -kBeyond;
    const bool has_axis = distance > 1e-6f, has_rim = has_axis & (c > -1) & (c < 1);
    const float length = has_axis ? kAxisLength * inverse : 0.0f;
    x[n] = whole(static_cast<float>(b.x[n]) * length);
    y[n] = whole(static_cast<float>(b.y[n]) * length);
    z[n] = whole(static_cast<float>(b.z[n]) * length);
    limit[n] = whole((has_axis ? known : kBeyond) * kProduct + kProductError);
    least[n] = whole((has_rim ? low : -kBeyond) * kProduct - kProductError);
  }
  for (std::size_t n = 0; n < 5 * room; ++n) out[n] = static_cast<std::int16_t>(scratch[n]);
}

std::int16_t product(std::int16_t ax, std::int16_t ay, std::int16_t az, std::int16_t bx, std::int16_t by,
                     std::int16_t bz) {
  return static_cast<std::int16_t>(ax * bx + ay * by + az * bz);
}
std::int16_t mask_of(bool yes) { return yes ? -1 : 0; }

// Computes, for each direction, in whole blocks, a number that is -1 if none of the listed caps contains it, else 0.
// Each step takes several caps, because the results of a block go through memory.
MENISCUS_VECTOR_CLONES
void sign_outside(const Points& directions, std::size_t count, const Caps& caps, const std::uint32_t* list,
                  std::size_t cap_count, std::int16_t* sign) {
  const Caps c = caps;
  for (std::size_t first = 0; first < count; first += kBlock) {
    const std::int16_t *x = directions.x + first, *y = directions.y + first, *z = directions.z + first;
    std::int16_t* outside = sign + first;
    for (std::size_t l = 0; l < kBlock; ++l) outside[l] = -1;
    for (std::size_t n = 0; n < cap_count; n += kStep) {
      const std::size_t a0 = list[n], a1 = list[n + 1], a2 = list[n + 2], a3 = list[n + 3];
      const std::int16_t x0 = c.x[a0], y0 = c.y[a0], z0 = c.z[a0], limit0 = c.limit[a0];
      const std::int16_t x1 = c.x[a1], y1 = c.y[a1], z1 = c.z[a1], limit1 = c.limit[a1];
      const std::int16_t x2 = c.x[a2], y2 = c.y[a2], z2 = c.z[a2], limit2 = c.limit[a2];
      const std::int16_t x3 = c.x[a3], y3 = c.y[a3], z3 = c.z[a3], limit3 = c.limit[a3];
      std::int16_t any = 0;
      MENISCUS_INDEPENDENT_STEPS
      for (std::size_t l = 0; l < kBlock; ++l) {
        const std::int16_t outside0 = mask_of(product(x0, y0, z0, x[l], y[l], z[l]) < limit0);
        const std::int16_t outside1 = mask_of(product(x1, y1, z1, x[l], y[l], z[l]) < limit1);
        const std::int16_t outside2 = mask_of(product(x2, y2, z2, x[l], y[l], z[l]) < limit2);
        const std::int16_t outside3 = mask_of(product(x3, y3, z3, x[l], y[l], z[l]) < limit3);
        outside[l] &= outside0 & outside1 & (outside2 & outside3);
        any |= outside[l];
      }
      if (any == 0) break;
    }
  }
}

// Computes, for each circle, in whole blocks, a number that is -1 if no direction is near it, else 0.
MENISCUS_VECTOR_CLONES
void sign_far(const Caps& caps, std::size_t count, const Points& directions, std::size_t direction_count,
              std::int16_t* sign) {
  const Points d = directions;
  for (std::size_t first = 0; first < count; first += kCircles) {
    const std::int16_t *x = caps.x + first, *y = caps.y + first, *z = caps.z + first;
    const std::int16_t *limit = caps.limit + first, *low = caps.low + first;
    std::int16_t* far = sign + first;
    for (std::size_t l = 0; l < kCircles; ++l) far[l] = -1;
    for (std::size_t n = 0; n < direction_count; n += kStep) {
      const std::int16_t x0 = d.x[n], y0 = d.y[n], z0 = d.z[n], x1 = d.x[n + 1], y1 = d.y[n + 1], z1 = d.z[n + 1];
      const std::int16_t x2 = d.x[n + 2], y2 = d.y[n + 2], z2 = d.z[n + 2], x3 = d.x[n + 3], y3 = d.y[n + 3],
                         z3 = d.z[n + 3];
      std::int16_t any = 0;
      MENISCUS_INDEPENDENT_STEPS
      for (std::size_t l = 0; l < kCircles; ++l) {
        const std::int16_t p0 = product(x[l], y[l], z[l], x0, y0, z0), p1 = product(x[l], y[l], z[l], x1, y1, z1);
        const std::int16_t p2 = product(x[l], y[l], z[l], x2, y2, z2), p3 = product(x[l], y[l], z[l], x3, y3, z3);
        const std::int16_t far0 = mask_of(p0 < low[l]) | mask_of(p0 >= limit[l]);
        const std::int16_t far1 = mask_of(p1 < low[l]) | mask_of(p1 >= limit[l]);
        const std::int16_t far2 = mask_of(p2 < low[l]) | mask_of(p2 >= limit[l]);
        const std::int16_t far3 = mask_of(p3 < low[l]) | mask_of(p3 >= limit[l]);
        far[l] &= far0 & far1 & (far2 & far3);
        any |= far[l];
      }
      if (any == 0) break;
    }
  }
}

// Fills a list up to whole steps by its last entry.
template <typename Number>
void repeat_last(Number* list, std::size_t count) {
  for (std::size_t n = count; n < whole_steps(count); ++n) list[n] = list[count - 1];
}

}  // namespace

// Lists the caps that cover something, the wide ones first: the others do not matter where these cover all.
void SphereCover::list_caps(const std::int16_t* limit, std::size_t count) {
  std::uint32_t* past = caps_.data();
  const auto append_between = [&](double low, double high) {
    const auto from = static_cast<std::int16_t>(low * kProduct), to = static_cast<std::int16_t>(high * kProduct);
    for (std::size_t n = 0; n < whole_blocks(count); ++n) signs_[n] = mask_of((limit[n] >= from) & (limit[n] < to));
    past = list_negative(signs_.data(), count, 0, past);
    return static_cast<std::size_t>(past - caps_.data());
  };
  wide_count_ = append_between(-1, kWide);
  cap_count_ = append_between(kWide, kBeyond);
  repeat_last(caps_.data(), cap_count_);
  cap_count_ = whole_steps(cap_count_);
  wide_count_ = std::min(whole_steps(wide_count_), cap_count_);
}

// Keeps the directions with a negative sign. They may be in the list already, because none moves to a later place.
void SphereCover::list_uncovered(const std::int16_t* x, const std::int16_t* y, const std::int16_t* z, std::size_t count,
                                 std::uint32_t* list) {
  uncovered_count_ = static_cast<std::size_t>(list_negative(signs_.data(), count, 0, list) - list);
  for (std::size_t n = 0; n < uncovered_count_; ++n) {
    const std::uint32_t direction = list[n];
    uncovered_[0][n] = x[direction];
    uncovered_[1][n] = y[direction];
    uncovered_[2][n] = z[direction];
  }
}

bool SphereCover::is_near(const glm::dvec3& point, std::span<const std::uint8_t> uncovered) {
  const WatchedDirections& w = watched();
  return std::ranges::any_of(uncovered, [&](std::uint8_t n) { return glm::dot(point, w.unit[n]) > w.cos_near; });
}

// Looks closer at the few directions that are left. Only balls whose circles may be exposed cover parts around them.
bool SphereCover::is_covered_closely(const Blockers& blockers) {
  const double radius = std::sqrt(blockers.first_weight());
  caps_left_.clear();
  for (std::size_t n = 0; n < blockers.size(); ++n) {
    if (!circle_may_be_exposed(n)) continue;
    const Blockers::Ball ball = blockers[n];
    const double cosine = ball.half_power / (ball.distance * radius), sine = std::sqrt(1 - cosine * cosine);
    caps_left_.push_back({ball.center / ball.distance, cosine, sine});
  }
  latest_ = 0;
  return !caps_left_.empty() &&
         std::ranges::all_of(uncovered(), [&](std::uint8_t n) { return is_covered_around(watched().unit[n], 0); });
}

// True if caps cover everything near a direction: each cap of this look lies in one of them, or is covered at the next
// look. The cap that covered the latest direction is tried first.
bool SphereCover::is_covered_around(const glm::dvec3& direction, std::size_t look) {
  const WatchedDirections::Look& here = watched().looks[look];
  const auto is_covered = [&](const glm::dvec3& d) {
    const auto covers = [&](const Cap& cap) {
      return cap.cosine < here.cos_angle &&
             glm::dot(cap.axis, d) > cap.cosine * here.cos_angle + cap.sine * here.sin_angle;
    };
    if (covers(caps_left_[latest_])) return true;
    const auto cap = std::ranges::find_if(caps_left_, covers);
    if (cap == caps_left_.end()) return look + 1 < kLooks && is_covered_around(d, look + 1);
    latest_ = static_cast<std::size_t>(cap - caps_left_.begin());
    return true;
  };
  if (!is_covered(direction)) return false;
  const glm::dvec3 u = glm::normalize(glm::cross(direction, {0.36, 0.48, 0.8})), v = glm::cross(direction, u);
  return std::ranges::all_of(watched().turns, [&](const glm::dvec2& turn) {
    return is_covered(here.cos_out * direction + here.sin_out * (turn.x * u + turn.y * v));
  });
}

bool SphereCover::test(const Blockers& blockers) {
  const WatchedDirections& w = watched();
  const std::size_t count = blockers.size(), room = whole_blocks(count), most = std::max(room, kPadded);
  if (signs_.size() < most) {
    products_.resize(2 * kCapColumns * most);
    circles_.resize(2 * kCapColumns * most);
    signs_.resize(2 * most);
    caps_.resize(2 * most + kLanes);
  }
  narrow_caps(blockers.columns(), whole_vectors(count), static_cast<float>(1 / std::sqrt(blockers.first_weight())),
              static_cast<float>(w.cos_angle), static_cast<float>(w.sin_angle), products_.data(), circles_.data(),
              room);
  const std::int16_t* column = circles_.data();
  const Caps caps{column, column + room, column + 2 * room, column + 3 * room, column + 4 * room};
  list_caps(caps.limit, count);
  sign_outside({w.x.data(), w.y.data(), w.z.data()}, kPadded, caps, caps_.data(), wide_count_, signs_.data());
  list_uncovered(w.x.data(), w.y.data(), w.z.data(), kDirections, outside_wide_.data());
  const Points left{uncovered_[0].data(), uncovered_[1].data(), uncovered_[2].data()};
  sign_outside(left, (uncovered_count_ + kBlock - 1) / kBlock * kBlock, caps, caps_.data() + wide_count_,
               cap_count_ - wide_count_, signs_.data());
  list_uncovered(left.x, left.y, left.z, uncovered_count_, outside_all_.data());
  for (std::size_t n = 0; n < uncovered_count_; ++n)
    uncovered_numbers_[n] = static_cast<std::uint8_t>(outside_wide_[outside_all_[n]]);
  if (uncovered_count_ == 0) return false;
  for (auto& numbers : uncovered_) repeat_last(numbers.data(), uncovered_count_);
  sign_far(caps, room, left, whole_steps(uncovered_count_), signs_.data());
  return uncovered_count_ > kFew || !is_covered_closely(blockers);
}

}  // namespace meniscus
