// SPDX-License-Identifier: BSD-3-Clause
// The shared geometry functions in quadruple precision, for decisions that double precision leaves in doubt.
#pragma once

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace meniscus {

/// A number of IEEE 754 binary128. Sums, differences, products and quotients are rounded to nearest, ties to even, so
/// that they have the same bits as with __float128 (tests/unit/math/binary128_test.cpp). Only the range is wider:
/// exponents have 32 bits, so that nothing overflows and nothing is subnormal.
class Binary128 {
 public:
  Binary128() = default;
  constexpr Binary128(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const auto exponent = static_cast<int>(bits >> 52 & 0x7ff);
    const std::uint64_t fraction = bits & 0xfffffffffffff;
    is_negative_ = bits >> 63 != 0;
    if (exponent == 0x7ff)
      *this = fraction == 0 ? infinity(is_negative_) : not_a_number();
    else if (exponent != 0 || fraction != 0)
      *this = rounded(is_negative_, Wide{exponent != 0 ? fraction | std::uint64_t{1} << 52 : fraction},
                      std::max(exponent, 1) - 1075, false);
  }
  constexpr Binary128(int value) : Binary128(static_cast<double>(value)) {}

  explicit operator double() const {
    if (is_nan()) return std::numeric_limits<double>::quiet_NaN();
    if (fraction_ == 0) return is_negative_ ? -0.0 : 0.0;
    if (is_infinite()) return is_negative_ ? -HUGE_VAL : HUGE_VAL;
    // A subnormal double has fewer bits.
    const int kept = std::min(53, exponent_ + kBits - 1 + 1075);
    if (kept < 0) return is_negative_ ? -0.0 : 0.0;
    const Rounded r = round_to(fraction_, exponent_, kept, false);
    const double size = std::ldexp(static_cast<double>(static_cast<std::uint64_t>(r.fraction)), r.exponent);
    return is_negative_ ? -size : size;
  }

  friend constexpr Binary128 operator-(Binary128 a) {
    a.is_negative_ = !a.is_negative_;
    return a;
  }

  friend Binary128 operator+(Binary128 a, Binary128 b) {
    if (a.is_nan() || b.is_nan()) return not_a_number();
    if (a.is_infinite() || b.is_infinite()) {
      if (a.is_infinite() && b.is_infinite() && a.is_negative_ != b.is_negative_) return not_a_number();
      return a.is_infinite() ? a : b;
    }
    if (b.fraction_ == 0) return a.fraction_ == 0 && !b.is_negative_ ? b : a;
    if (a.fraction_ == 0) return b;
    if (a.exponent_ < b.exponent_) std::swap(a, b);
    // Both fractions are shifted to the left by 14 bits. Together with `more`, which notes bits lost at the right, that
    // suffices for every rounding.
    constexpr int kGuard = 14;
    const Wide large = a.fraction_ << kGuard;
    Wide small = b.fraction_ << kGuard;
    const int shift = a.exponent_ - b.exponent_;
    const bool more = shift >= 128 || (shift > 0 && (small & ((Wide{1} << shift) - 1)) != 0);
    small = shift >= 128 ? 0 : small >> shift;
    if (a.is_negative_ == b.is_negative_) return rounded(a.is_negative_, large + small, a.exponent_ - kGuard, more);
    if (large == small && !more) return 0.0;
    if (small > large) return rounded(b.is_negative_, small - large, a.exponent_ - kGuard, false);
    return rounded(a.is_negative_, large - small - (more ? 1 : 0), a.exponent_ - kGuard, more);
  }
  friend Binary128 operator-(Binary128 a, Binary128 b) { return a + -b; }

  friend Binary128 operator*(Binary128 a, Binary128 b) {
    const bool negative = a.is_negative_ != b.is_negative_, zero = a.fraction_ == 0 || b.fraction_ == 0;
    const bool infinite = a.is_infinite() || b.is_infinite();
    if (a.is_nan() || b.is_nan() || (infinite && zero)) return not_a_number();
    if (infinite) return infinity(negative);
    if (zero) return negative ? -0.0 : 0.0;
    const Wide low_mask = ~std::uint64_t{0};
    const Wide a0 = a.fraction_ & low_mask, a1 = a.fraction_ >> 64, b0 = b.fraction_ & low_mask, b1 = b.fraction_ >> 64;
    const Wide low = a0 * b0, middle = a1 * b0 + (low >> 64), other = a0 * b1 + (middle & low_mask);
    const Wide high = a1 * b1 + (middle >> 64) + (other >> 64);  // the unit is 2^128; the number has at most 98 bits
    const Wide rest = other << 64 | (low & low_mask);
    constexpr int kUp = 29;  // 127 of the 128 bits are used after the shift
    return rounded(negative, high << kUp | rest >> (128 - kUp), a.exponent_ + b.exponent_ + 128 - kUp,
                   rest << kUp != 0);
  }

  friend Binary128 operator/(Binary128 a, Binary128 b) {
    const bool negative = a.is_negative_ != b.is_negative_;
    const bool both = (a.fraction_ == 0 && b.fraction_ == 0) || (a.is_infinite() && b.is_infinite());
    if (a.is_nan() || b.is_nan() || both) return not_a_number();
    if (a.is_infinite() || b.fraction_ == 0) return infinity(negative);
    if (a.fraction_ == 0 || b.is_infinite()) return negative ? -0.0 : 0.0;
    constexpr int kQuotientBits = kBits + 3;
    Wide quotient = 0, rest = a.fraction_;
    for (int n = 0; n <= kQuotientBits; ++n) {
      quotient <<= 1;
      if (rest >= b.fraction_) {
        rest -= b.fraction_;
        quotient |= 1;
      }
      rest <<= 1;
    }
    return rounded(negative, quotient, a.exponent_ - b.exponent_ - kQuotientBits, rest != 0);
  }

  Binary128& operator+=(Binary128 other) { return *this = *this + other; }
  Binary128& operator-=(Binary128 other) { return *this = *this - other; }
  Binary128& operator*=(Binary128 other) { return *this = *this * other; }

  friend bool operator==(Binary128 a, Binary128 b) {
    if (a.is_nan() || b.is_nan()) return false;
    if (a.fraction_ == 0 || b.fraction_ == 0) return a.fraction_ == b.fraction_;
    return a.is_negative_ == b.is_negative_ && a.exponent_ == b.exponent_ && a.fraction_ == b.fraction_;
  }
  friend bool operator<(Binary128 a, Binary128 b) {
    if (a.is_nan() || b.is_nan()) return false;
    if (a.fraction_ == 0) return b.fraction_ != 0 && !b.is_negative_;
    if (b.fraction_ == 0) return a.is_negative_;
    if (a.is_negative_ != b.is_negative_) return a.is_negative_;
    if (a.exponent_ != b.exponent_) return (a.exponent_ < b.exponent_) != a.is_negative_;
    return a.is_negative_ ? a.fraction_ > b.fraction_ : a.fraction_ < b.fraction_;
  }
  friend bool operator>(Binary128 a, Binary128 b) { return b < a; }
  friend bool operator<=(Binary128 a, Binary128 b) { return a < b || a == b; }
  friend bool operator>=(Binary128 a, Binary128 b) { return b < a || a == b; }

 private:
  __extension__ typedef unsigned __int128 Wide;

  static constexpr int kBits = 113;                                                            // bits of a fraction
  static constexpr int kInfinite = std::numeric_limits<int>::max() - 1, kNan = kInfinite + 1;  // exponents

  struct Rounded {
    Wide fraction;
    int exponent;
  };

  static constexpr int width(Wide a) {
    const auto high = static_cast<std::uint64_t>(a >> 64);
    return high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(static_cast<std::uint64_t>(a));
  }

  // Rounds fraction * 2^exponent to so many bits. With `more` the number is larger than that by less than one unit of
  // the fraction.
  static constexpr Rounded round_to(Wide fraction, int exponent, int bits, bool more) {
    const int drop = width(fraction) - bits;
    if (drop <= 0) return {fraction << -drop, exponent + drop};
    const Wide half = Wide{1} << (drop - 1), rest = fraction & ((half << 1) - 1);
    Wide kept = drop < 128 ? fraction >> drop : 0;
    if (rest > half || (rest == half && (more || (kept & 1) != 0))) ++kept;
    return {kept, exponent + drop};
  }

  static constexpr Binary128 rounded(bool negative, Wide fraction, int exponent, bool more) {
    Rounded r = round_to(fraction, exponent, kBits, more);
    if (width(r.fraction) > kBits) r = {r.fraction >> 1, r.exponent + 1};
    Binary128 number;
    number.is_negative_ = negative;
    number.fraction_ = r.fraction;
    number.exponent_ = r.exponent;
    return number;
  }

  // Makes an infinity, or NaN. An infinity is the largest of all numbers, so that comparisons need no special case.
  static constexpr Binary128 with_exponent(int exponent, bool negative) {
    Binary128 number;
    number.fraction_ = Wide{1} << (kBits - 1);
    number.exponent_ = exponent;
    number.is_negative_ = negative;
    return number;
  }
  static constexpr Binary128 infinity(bool negative) { return with_exponent(kInfinite, negative); }
  static constexpr Binary128 not_a_number() { return with_exponent(kNan, false); }
  bool is_infinite() const { return exponent_ == kInfinite; }
  bool is_nan() const { return exponent_ == kNan; }

  Wide fraction_ = 0;  // zero, or at least 2^112
  int exponent_ = 0;   // the number is fraction_ * 2^exponent_
  bool is_negative_ = false;
};

}  // namespace meniscus

#define GEOMETRY inline
#define GEOMETRY_OUT(type) type&
#define GEOMETRY_INOUT(type) type&

namespace meniscus::quad_geometry {

using uint = std::uint32_t;

// IEEE 754 binary128 by the compiler's type for it, or else by integers. All give the same bits.
#if defined(MENISCUS_BINARY128)
using real = Binary128;
#elif defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 real;
#elif LDBL_MANT_DIG == 113
using real = long double;
#else
using real = Binary128;
#endif

inline constexpr real kUnitRoundoff = 0x1p-113;

struct real2 {
  real x, y;
  real2() = default;
  real2(real x_, real y_) : x(x_), y(y_) {}
};
struct real3 {
  real x, y, z;
  real3() = default;
  real3(real x_, real y_, real z_) : x(x_), y(y_), z(z_) {}
};

inline real2 operator+(real2 a, real2 b) { return {a.x + b.x, a.y + b.y}; }
inline real2 operator-(real2 a, real2 b) { return {a.x - b.x, a.y - b.y}; }
inline real2 operator*(real2 a, real s) { return {a.x * s, a.y * s}; }
inline real3 operator+(real3 a, real3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline real3 operator-(real3 a, real3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline real3 operator*(real3 a, real s) { return {a.x * s, a.y * s, a.z * s}; }
inline real3 operator/(real3 a, real s) { return {a.x / s, a.y / s, a.z / s}; }
inline real dot(real2 a, real2 b) { return a.x * b.x + a.y * b.y; }
inline real dot(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline real3 cross(real3 a, real3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline real abs(real a) { return a < 0 ? -a : a; }
inline real min(real a, real b) { return b < a ? b : a; }
inline real max(real a, real b) { return a < b ? b : a; }

// Returns the square root by two Newton steps from the root in double precision. They turn 53 correct bits into more
// than the 113 that a real has.
inline real sqrt(real a) {
  if (!(a > 0)) return 0;
  real x = std::sqrt(static_cast<double>(a));
  if (!(x > 0)) return 0;
  x = (x + a / x) / 2;
  return (x + a / x) / 2;
}

#undef MENISCUS_GEOMETRY_CIRCLE_GLSL
#include "gpu_shaders/geometry/circle.glsl"
#undef MENISCUS_GEOMETRY_CIRCLE_GLSL  // double_geometry.h, too, may include it

}  // namespace meniscus::quad_geometry
