// SPDX-License-Identifier: BSD-3-Clause
// The shared geometry functions in quadruple precision, for decisions that double precision leaves in doubt.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstdint>

#include "core/math/binary128.h"

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

}  // namespace meniscus::quad_geometry
