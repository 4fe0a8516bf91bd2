// SPDX-License-Identifier: BSD-3-Clause
// The error bound of the half-planes of circle.glsl against arithmetic as poor as GLSL allows: as a sum over all
// roundings, and on random circles.
#include <algorithm>
#include <cmath>
#include <compare>
#include <random>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

template <typename T>
struct Vector2 {
  T x, y;
};
template <typename T>
struct Vector3 {
  T x, y, z;
  Vector3 operator/(T s) const { return {x / s, y / s, z / s}; }
  Vector3 operator*(T s) const { return {x * s, y * s, z * s}; }
  Vector3 operator+(const Vector3& o) const { return {x + o.x, y + o.y, z + o.z}; }
  Vector3 operator-(const Vector3& o) const { return {x - o.x, y - o.y, z - o.z}; }
};
template <typename T>
Vector2<T> operator-(const Vector2<T>& a, const Vector2<T>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <typename T>
Vector2<T> operator+(const Vector2<T>& a, const Vector2<T>& b) {
  return {a.x + b.x, a.y + b.y};
}
template <typename T>
Vector2<T> operator*(const Vector2<T>& a, T s) {
  return {a.x * s, a.y * s};
}
template <typename T>
T dot(const Vector2<T>& a, const Vector2<T>& b) {
  return a.x * b.x + a.y * b.y;
}
template <typename T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Single precision as a GPU may have it: products are rounded or kept for a fused sum, by chance; quotients and roots
/// are off by the most that GLSL allows, to either side.
class Sloppy {
 public:
  Sloppy() = default;
  Sloppy(double value) : value_(value) {}
  double value() const { return value_; }
  auto operator<=>(const Sloppy&) const = default;
  Sloppy operator-() const { return -value_; }
  friend Sloppy operator+(Sloppy a, Sloppy b) { return rounded(a.value_ + b.value_); }
  friend Sloppy operator-(Sloppy a, Sloppy b) { return rounded(a.value_ - b.value_); }
  friend Sloppy operator*(Sloppy a, Sloppy b) {
    const double product = rounded(a.value_) * rounded(b.value_);
    return coin() ? product : rounded(product);
  }
  friend Sloppy operator/(Sloppy a, Sloppy b) { return off_by(2.5 * ulps, rounded(a.value_) / rounded(b.value_)); }
  friend Sloppy sqrt(Sloppy a) { return off_by(4.5 * ulps, std::sqrt(rounded(a.value_))); }
  friend Sloppy abs(Sloppy a) { return std::abs(a.value_); }

  static inline double ulps = 1.0;  ///< times what GLSL allows
  static inline std::mt19937 random{7};

 private:
  static bool coin() { return (random() & 1u) != 0; }
  static double rounded(double value) { return static_cast<float>(value); }
  static double off_by(double units, double value) {
    return rounded(value * (1.0 + (coin() ? 1.0 : -1.0) * (units - 0.5) * 0x1p-23));
  }

  double value_ = 0.0;
};

#define GEOMETRY inline
#define GEOMETRY_OUT(type) type&
#define GEOMETRY_INOUT(type) type&

namespace sloppy {
using uint = unsigned;
using real = Sloppy;
using real2 = Vector2<real>;
using real3 = Vector3<real>;
using std::max;
using std::min;
#include "gpu_shaders/geometry/circle.glsl"
}  // namespace sloppy

#undef MENISCUS_GEOMETRY_CIRCLE_GLSL

namespace sharp {
using uint = unsigned;
using real = long double;
using real2 = Vector2<real>;
using real3 = Vector3<real>;
using std::abs;
using std::max;
using std::min;
using std::sqrt;
#include "gpu_shaders/geometry/circle.glsl"
}  // namespace sharp

constexpr double kUnit = 0x1p-24;  // unit roundoff

/// Lengths in units of the first ball's radius R. z: distance of the second ball; s: R / radius of the circle; h:
/// height of the circle; x: distance of the covering ball.
struct Circumstances {
  double z, s, h, x;
  double second_square() const { return z * z + 1 - 2 * z * h; }  ///< squared radius of the second ball
};

/// The worst error of covered_half_plane in unit roundoffs over what half_plane_noise(c, 1) / 18 allows, if all
/// roundings push to one side: each sum and product is off by 1, quotients by 5 (2.5 ulp), roots by 9 (inversesqrt 2
/// ulp, its inverse 2.5), and what comes in, differences of single precision and their squares, by 3.
double sum_of_errors(const Circumstances& c) {
  constexpr double kQuotient = 5, kRoot = 9, kInput = 3;
  const double height = std::abs(c.h), x = c.x, z = c.z, second = c.second_square();
  const double distance = 1.5 + kRoot;  // of the balls; common to axis and height, where half of it cancels
  // |(u.q, v.q)|: lengths and directions of u, v and the axis.
  const double normal = x * (2 * (1.5 + kRoot + kQuotient) + 2 + 3 + kQuotient + 2 * kInput);
  // height = (z*z + w0 - w1) / 2z
  const double height_error =
      z + 0.5 / z + height * (1 + kQuotient) + kInput * (1 + second) / (2 * z) + kInput * std::abs(z - c.h);
  // (w0 + qq - wq) / 2 - height * dot(axis, q); the covering ball meets the circle: wq <= (1 + x)^2
  const double numerator = (4 * x * x + 1) / 2 + x + (2 * kInput * x * x + kInput + kInput * (1 + x) * (1 + x)) / 2 +
                           height * x * (3 + kQuotient + 2 * kInput + 1) + x / c.s +
                           distance * x * std::abs(1 - second) / z + x * height_error;
  // 1 / sqrt(w0 - height^2)
  const double inverse_radius =
      c.s * c.s * (c.h * c.h + 1 / (c.s * c.s) + 2 * height * (distance * std::abs(z - c.h) + height_error) + kInput) /
          2 +
      kRoot + kQuotient;
  const double error = normal + c.s * numerator + x * inverse_radius;  // |offset| <= |normal| <= x where it matters
  const double allowed = (1 + 1 / z + z) * (1 + x * x) * (1 + x * c.s) * c.s;
  return error / allowed;
}

template <typename Visit>
void for_each_power(double first, double last, int count, Visit visit) {
  for (int n = 0; n < count; ++n) visit(first * std::pow(last / first, n / (count - 1.0)));
}

TEST(CircleErrors, SumToNoMoreThanTheBound) {
  double worst = 0.0;
  for_each_power(1e-3, 1e3, 90, [&](double z) {
    for_each_power(1.0, 1e6, 60, [&](double s) {
      for (const double side : {-1.0, 1.0}) {
        const double h = side * std::sqrt(std::max(0.0, 1 - 1 / (s * s)));
        for_each_power(1e-3, 1e3, 90, [&](double x) { worst = std::max(worst, sum_of_errors({z, s, h, x})); });
      }
    });
  });
  EXPECT_LE(worst, 18.0) << "the factor in half_plane_noise()";
  EXPECT_GT(worst, 16.0) << "a smaller factor would do";
}

/// Draws random circles with a ball that all but touches each, where the last bits decide, and returns the largest
/// error over its bound.
class RandomCircles {
 public:
  double worst_share(int count) {
    double worst = 0.0;
    for (int n = 0; n < count; ++n) worst = std::max(worst, share());
    return worst;
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double power(double low, double high) { return low * std::pow(high / low, uniform(0.0, 1.0)); }
  Vector3<double> direction() {
    std::normal_distribution<double> normal;
    const Vector3<double> v{normal(random_), normal(random_), normal(random_)};
    return v / std::sqrt(dot(v, v));
  }

  double share() {
    const double radius = power(0.5, 20.0), s = power(1.0, 15.0);
    const double h = (uniform(0, 1) < 0.3 ? -1 : 1) * radius * std::sqrt(1 - 1 / (s * s));
    const Vector3<double> axis = direction();
    const Vector3<double> d = axis * (radius * power(0.05, 4.0));
    const double w0 = radius * radius, w1 = dot(d, d) + w0 - 2 * h * std::sqrt(dot(d, d));
    if (w1 <= 0.0) return 0.0;
    // A ball about q touches the circle at this point or opposite.
    const Vector3<double> side = cross(axis, direction());
    const Vector3<double> point = axis * h + side * (radius / s / std::sqrt(dot(side, side)));
    const Vector3<double> q = axis * (radius * uniform(-1.5, 1.5)) + side * (radius * uniform(-1.5, 1.5));
    const Vector3<double> gap = q - point;
    return share_of({single(d.x), single(d.y), single(d.z)}, {single(q.x), single(q.y), single(q.z)}, single(w0),
                    single(w1), single(dot(gap, gap)));
  }

  static double single(double value) { return static_cast<float>(value); }

  static double share_of(const Vector3<double>& d, const Vector3<double>& q, double w0, double w1, double wq) {
    const auto rough = sloppy::covered_half_plane(sloppy::circle_of_two_spheres({d.x, d.y, d.z}, w0, w1), w0,
                                                  {q.x, q.y, q.z}, sqrt(Sloppy(dot(q, q))), wq, kUnit);
    const auto true_circle = sharp::circle_of_two_spheres({d.x, d.y, d.z}, w0, w1);
    if (true_circle.radius_squared < 65536 * kUnit * w0) return 0.0;  // Such circles are in doubt anyway.
    const auto truth = sharp::covered_half_plane(true_circle, w0, {q.x, q.y, q.z}, std::sqrt(dot(q, q)), wq, kUnit);
    const long double offset_error = std::abs(rough.offset.value() - truth.offset);
    const long double normal_error =
        std::abs(std::hypot(rough.normal.x.value(), rough.normal.y.value()) - std::sqrt(truth.length_squared));
    return static_cast<double>((offset_error + normal_error) / rough.error.value());
  }

  std::mt19937 random_{11};
};

TEST(CircleErrors, StayWithinTheBoundOnPoorArithmetic) {
  Sloppy::ulps = 1.0;
  const double worst = RandomCircles().worst_share(200000);
  EXPECT_LT(worst, 1.0);
  EXPECT_GT(worst, 0.02) << "a bound so wide sends more circles to double than need be";
}

TEST(CircleErrors, LeaveTheBoundOnWorseArithmetic) {
  Sloppy::ulps = 1024.0;
  EXPECT_GT(RandomCircles().worst_share(20000), 1.0) << "the test above sees nothing";
  Sloppy::ulps = 1.0;
}

}  // namespace
}  // namespace meniscus
