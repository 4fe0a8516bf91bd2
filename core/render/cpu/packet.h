// SPDX-License-Identifier: BSD-3-Clause
// Packets of numbers, one for each of MENISCUS_LANES rays: the types of gpu_shaders/reduced_surface/precision.glsl for
// C++.
//
// There are only operations that IEEE 754 rounds correctly, equally in every lane, and functions made of them. So a
// picture is the same to the bit for any width of the machine's vectors. Functions that the shared sources call have
// GLSL's names. Only lanes_*.cpp include this, each with its own lanes and instructions.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#if defined(__x86_64__)
#include <immintrin.h>

#endif

#define GEOMETRY inline
#define GEOMETRY_OUT(type) type&
#define GEOMETRY_INOUT(type) type&

namespace meniscus::MENISCUS_LANE_NAMESPACE {

inline constexpr int kLanes = MENISCUS_LANES;

using uint = std::uint32_t;
using Floats [[gnu::vector_size(4 * MENISCUS_LANES)]] = float;
using Ints [[gnu::vector_size(4 * MENISCUS_LANES)]] = std::int32_t;
using Uints [[gnu::vector_size(4 * MENISCUS_LANES)]] = std::uint32_t;

struct integer;

struct real {
  Floats v;
  real() = default;
  real(Floats lanes) : v(lanes) {}
  real(float all) : v(all - Floats{}) {}  // adding -0 changes no value, not even -0
  real(double all) : real(static_cast<float>(all)) {}
  real(int all) : real(static_cast<float>(all)) {}
  explicit real(integer lanes);
};

/// A mask: all bits of a lane are equal.
struct truth {
  Ints v;
  truth() = default;
  truth(Ints lanes) : v(lanes) {}
  truth(bool all) : v(Ints{} - static_cast<std::int32_t>(all)) {}
};

struct integer {
  Ints v;
  integer() = default;
  integer(Ints lanes) : v(lanes) {}
  integer(std::int32_t all) : v(Ints{} + all) {}
};

struct natural {
  Uints v;
  natural() = default;
  natural(Uints lanes) : v(lanes) {}
  natural(std::uint32_t all) : v(Uints{} + all) {}
};

inline real::real(integer lanes) : v(__builtin_convertvector(lanes.v, Floats)) {}

inline real operator+(real a, real b) { return a.v + b.v; }
inline real operator-(real a, real b) { return a.v - b.v; }
inline real operator*(real a, real b) { return a.v * b.v; }
inline real operator/(real a, real b) { return a.v / b.v; }
inline real operator-(real a) { return -a.v; }
inline real& operator+=(real& a, real b) { return a = a + b; }
inline real& operator*=(real& a, real b) { return a = a * b; }
inline truth operator<(real a, real b) { return Ints(a.v < b.v); }
inline truth operator>(real a, real b) { return Ints(a.v > b.v); }
inline truth operator<=(real a, real b) { return Ints(a.v <= b.v); }
inline truth operator>=(real a, real b) { return Ints(a.v >= b.v); }
inline truth operator==(real a, real b) { return Ints(a.v == b.v); }
inline truth operator!=(real a, real b) { return Ints(a.v != b.v); }

inline truth operator&&(truth a, truth b) { return a.v & b.v; }
inline truth operator||(truth a, truth b) { return a.v | b.v; }
inline truth operator!(truth a) { return ~a.v; }
inline truth operator!=(truth a, truth b) { return a.v ^ b.v; }

inline integer operator+(integer a, integer b) { return a.v + b.v; }
inline integer operator-(integer a, integer b) { return a.v - b.v; }
inline integer operator-(integer a) { return -a.v; }
inline integer operator*(integer a, integer b) { return a.v * b.v; }
inline integer operator&(integer a, integer b) { return a.v & b.v; }
inline integer operator|(integer a, integer b) { return a.v | b.v; }
inline integer operator~(integer a) { return ~a.v; }
inline integer operator^(integer a, integer b) { return a.v ^ b.v; }
inline integer operator<<(integer a, int b) { return a.v << b; }
inline integer operator>>(integer a, int b) { return a.v >> b; }
inline truth operator>=(integer a, integer b) { return Ints(a.v >= b.v); }
inline truth operator<(integer a, integer b) { return Ints(a.v < b.v); }
inline truth operator==(integer a, integer b) { return Ints(a.v == b.v); }
inline truth operator!=(integer a, integer b) { return Ints(a.v != b.v); }

inline natural operator+(natural a, natural b) { return a.v + b.v; }
inline truth operator<(natural a, natural b) { return Ints(a.v < b.v); }
inline truth operator==(natural a, natural b) { return Ints(a.v == b.v); }
inline truth operator!=(natural a, natural b) { return Ints(a.v != b.v); }

inline real select(truth c, real a, real b) { return c.v ? a.v : b.v; }
inline integer select(truth c, integer a, integer b) { return c.v ? a.v : b.v; }
inline natural select(truth c, natural a, natural b) { return c.v ? a.v : b.v; }

/// Returns 0, 1, 2, ...
inline integer lane_numbers() {
  Ints lanes;
  for (int n = 0; n < kLanes; ++n) lanes[n] = n;
  return lanes;
}

/// Returns bit n for lane n.
inline uint bits(truth a) {
#if MENISCUS_LANES == 4 && defined(__x86_64__)
  return static_cast<uint>(_mm_movemask_ps(__builtin_bit_cast(__m128, a.v)));
#elif MENISCUS_LANES == 8 && defined(__x86_64__)
  return static_cast<uint>(_mm256_movemask_ps(__builtin_bit_cast(__m256, a.v)));
#elif MENISCUS_LANES == 16 && defined(__x86_64__)
  return static_cast<uint>(_mm512_movepi32_mask(__builtin_bit_cast(__m512i, a.v)));
#else
  uint result = 0;
  for (int n = 0; n < kLanes; ++n) result |= (static_cast<uint>(a.v[n]) & 1u) << n;
  return result;
#endif
}
inline bool some(truth a) { return bits(a) != 0; }

inline real sqrt(real a) {
#if MENISCUS_LANES == 4 && defined(__x86_64__)
  return __builtin_bit_cast(Floats, _mm_sqrt_ps(__builtin_bit_cast(__m128, a.v)));
#elif MENISCUS_LANES == 8 && defined(__x86_64__)
  return __builtin_bit_cast(Floats, _mm256_sqrt_ps(__builtin_bit_cast(__m256, a.v)));
#elif MENISCUS_LANES == 16 && defined(__x86_64__)
  return __builtin_bit_cast(Floats, _mm512_maskz_sqrt_ps(0xffff, __builtin_bit_cast(__m512, a.v)));
#else
  Floats result;
  for (int n = 0; n < kLanes; ++n) result[n] = std::sqrt(a.v[n]);
  return result;
#endif
}

inline Ints bits_of(real a) { return __builtin_bit_cast(Ints, a.v); }
inline real from_bits(Ints a) { return __builtin_bit_cast(Floats, a); }
inline real abs(real a) { return from_bits(bits_of(a) & 0x7fffffff); }
#if MENISCUS_LANES == 4 && defined(__x86_64__)
inline Floats lesser(Floats a, Floats b) { return _mm_min_ps(a, b); }
inline Floats greater(Floats a, Floats b) { return _mm_max_ps(a, b); }
#elif MENISCUS_LANES == 8 && defined(__x86_64__)
inline Floats lesser(Floats a, Floats b) { return _mm256_min_ps(a, b); }
inline Floats greater(Floats a, Floats b) { return _mm256_max_ps(a, b); }
#elif MENISCUS_LANES == 16 && defined(__x86_64__)
inline Floats lesser(Floats a, Floats b) { return _mm512_maskz_min_ps(0xffff, a, b); }
inline Floats greater(Floats a, Floats b) { return _mm512_maskz_max_ps(0xffff, a, b); }
#else
inline Floats lesser(Floats a, Floats b) { return a < b ? a : b; }
inline Floats greater(Floats a, Floats b) { return a > b ? a : b; }
#endif
// The result is a if both are equal or one is not a number.
inline real min(real a, real b) { return lesser(b.v, a.v); }
inline real max(real a, real b) { return greater(b.v, a.v); }
inline real clamp(real a, real low, real high) { return min(max(a, low), high); }
inline real mix(real a, real b, real share) { return a * (1.0f - share) + b * share; }
/// Returns the nearest integers, the even one of two; |a| < 2^22.
inline real round(real a) {
  const float shift = 12582912.0f;  // 1.5 * 2^23: no digit is left after the point
  return (a + shift) - shift;
}
inline integer to_whole(real a) { return __builtin_convertvector(a.v, Ints); }
inline real smoothstep(real low, real high, real a) {
  const real x = clamp((a - low) / (high - low), 0.0f, 1.0f);
  return x * x * (3.0f - 2.0f * x);
}

inline float lane(real a, int n) { return a.v[n]; }
inline uint lane(natural a, int n) { return a.v[n]; }

/// Returns the maximum of all lanes.
inline float greatest(real a) {
  float result = a.v[0];
  for (int n = 1; n < kLanes; ++n) result = result < a.v[n] ? a.v[n] : result;
  return result;
}

// This is Cephes (Moshier 1992), with relative errors of about 2e-7.
inline real log2(real a) {
  Ints exponent = (bits_of(a) >> 23) - 126;
  real m = from_bits((bits_of(a) & 0x007fffff) | 0x3f000000);  // in [0.5, 1)
  const Ints small = Ints(m.v < 0.70710678f);
  exponent += small;
  m = select(small, m + m, m) - 1.0f;
  const real z = m * m;
  real y = 7.0376836292e-2f;
  for (const float c : {-1.1514610310e-1f, 1.1676998740e-1f, -1.2420140846e-1f, 1.4249322787e-1f, -1.6668057665e-1f,
                        2.0000714765e-1f, -2.4999993993e-1f, 3.3333331174e-1f})
    y = y * m + c;
  y = y * m * z - 0.5f * z;
  return (m + y) * 1.44269504f + real(integer(exponent));
}

inline real exp2(real a) {
  a = clamp(a, -126.0f, 127.0f);
  const real nearest = round(a);
  const real x = (a - nearest) * 0.69314718f;
  real y = 1.9875691500e-4f;
  for (const float c : {1.3981999507e-3f, 8.3334519073e-3f, 4.1665795894e-2f, 1.6666665459e-1f, 5.0000001201e-1f})
    y = y * x + c;
  y = y * x * x + x + 1.0f;
  return y * from_bits((to_whole(nearest).v + 127) << 23);
}

/// Returns powers of a >= 0; 0 for a = 0.
inline real pow(real a, real exponent) { return select(a > 0.0f, exp2(exponent * log2(a)), 0.0f); }

struct SineCosine {
  real sine, cosine;
};

/// Returns sine and cosine; |a| < 1000.
inline SineCosine sine_cosine(real a) {
  const real quarter = round(a * 0.63661977f);
  const Ints quadrant = to_whole(quarter).v;
  const real x = ((a - quarter * 1.5703125f) - quarter * 4.837512969970703e-4f) - quarter * 7.549789948768648e-8f;
  const real z = x * x;
  const real s = ((-1.9515295891e-4f * z + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * x + x;
  const real c =
      ((2.443315711809948e-5f * z - 1.388731625493765e-3f) * z + 4.166664568298827e-2f) * z * z - 0.5f * z + 1.0f;
  const truth swapped = Ints((quadrant & 1) != 0);
  const real sine = select(swapped, c, s), cosine = select(swapped, s, c);
  return {from_bits(bits_of(sine) ^ ((quadrant & 2) << 30)), from_bits(bits_of(cosine) ^ (((quadrant + 1) & 2) << 30))};
}
inline real sin(real a) { return sine_cosine(a).sine; }
inline real cos(real a) { return sine_cosine(a).cosine; }

/// Returns the arc cosine, -1 <= a <= 1, with an error below 1e-7 (Abramowitz & Stegun 1964, 4.4.46).
inline real acos(real a) {
  const real x = abs(a);
  real y = -0.0012624911f;
  for (const float c :
       {0.0066700901f, -0.0170881256f, 0.0308918810f, -0.0501743046f, 0.0889789874f, -0.2145988016f, 1.5707963050f})
    y = y * x + c;
  y = y * sqrt(1.0f - x);
  return select(a < 0.0f, 3.14159265f - y, y);
}

struct real2 {
  real x, y;
  real2() = default;
  real2(real x_, real y_) : x(x_), y(y_) {}
  real2(const glm::vec2& all) : x(all.x), y(all.y) {}
  explicit real2(const struct integer2& lanes);
  explicit real2(const glm::ivec2& all) : real2(glm::vec2(all)) {}
};
inline real2 operator+(real2 a, real2 b) { return {a.x + b.x, a.y + b.y}; }
inline real2 operator-(real2 a, real2 b) { return {a.x - b.x, a.y - b.y}; }
inline real2 operator-(real2 a) { return {-a.x, -a.y}; }
inline real2 operator*(real2 a, real s) { return {a.x * s, a.y * s}; }
inline real dot(real2 a, real2 b) { return a.x * b.x + a.y * b.y; }
inline real length(real2 a) { return sqrt(dot(a, a)); }

struct real3 {
  real x, y, z;
  real3() = default;
  explicit real3(real all) : x(all), y(all), z(all) {}
  real3(real x_, real y_, real z_) : x(x_), y(y_), z(z_) {}
  real3(const glm::vec3& all) : x(all.x), y(all.y), z(all.z) {}
};
inline real3 operator+(const real3& a, const real3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline real3 operator-(const real3& a, const real3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline real3 operator-(const real3& a) { return {-a.x, -a.y, -a.z}; }
inline real3 operator*(const real3& a, const real3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline real3 operator*(const real3& a, real s) { return {a.x * s, a.y * s, a.z * s}; }
inline real3 operator*(real s, const real3& a) { return a * s; }
inline real3 operator/(const real3& a, real s) { return {a.x / s, a.y / s, a.z / s}; }
inline real3 operator/(const real3& a, const real3& b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }
inline real3 select(truth c, const real3& a, const real3& b) {
  return {select(c, a.x, b.x), select(c, a.y, b.y), select(c, a.z, b.z)};
}
inline real3 mix(const real3& a, const real3& b, real share) {
  return {mix(a.x, b.x, share), mix(a.y, b.y, share), mix(a.z, b.z, share)};
}
inline real dot(const real3& a, const real3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline real length(const real3& a) { return sqrt(dot(a, a)); }
inline real3 normalize(const real3& a) { return a * (1.0f / length(a)); }
inline real3 cross(const real3& a, const real3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct integer2 {
  integer x, y;
  integer2() = default;
  integer2(integer x_, integer y_) : x(x_), y(y_) {}
  explicit integer2(real2 lanes) : x(to_whole(lanes.x)), y(to_whole(lanes.y)) {}
};
inline integer2 operator+(integer2 a, integer2 b) { return {a.x + b.x, a.y + b.y}; }
inline integer2 operator-(integer2 a, integer2 b) { return {a.x - b.x, a.y - b.y}; }
inline real2::real2(const integer2& lanes) : x(lanes.x), y(lanes.y) {}

/// Adjacent pixels, one for each lane, given by the first of them.
struct pixel_row {
  int x, y;
  operator integer2() const { return {integer(x) + lane_numbers(), integer(y)}; }
};
inline pixel_row operator+(pixel_row a, glm::ivec2 way) { return {a.x + way.x, a.y + way.y}; }
inline glm::ivec2 operator-(pixel_row a, pixel_row b) { return {a.x - b.x, a.y - b.y}; }

inline real2 round(real2 a) { return {round(a.x), round(a.y)}; }

/// Returns values[at] for each lane.
inline real gather(const float* values, integer at) {
#if MENISCUS_LANES == 8 && defined(__x86_64__)
  return __builtin_bit_cast(Floats, _mm256_i32gather_ps(values, __builtin_bit_cast(__m256i, at.v), 4));
#elif MENISCUS_LANES == 16 && defined(__x86_64__)
  const __m512i places = __builtin_bit_cast(__m512i, at.v);
  return __builtin_bit_cast(Floats, _mm512_mask_i32gather_ps(_mm512_setzero_ps(), 0xffff, places, values, 4));
#else
  Floats result;
  for (int n = 0; n < kLanes; ++n) result[n] = values[at.v[n]];
  return result;
#endif
}

/// Returns values[at] and values[at + 1] for each lane.
inline real2 gather_two(const float* values, integer at) {
#if MENISCUS_LANES == 8 && defined(__x86_64__)
  // Each number of 64 bits is two floats. Lanes 0, 1, 4, 5 come first, because shuffles do not cross halves.
  const __m256i places = _mm256_permute4x64_epi64(__builtin_bit_cast(__m256i, at.v), 0xd8);
  const auto* const pairs = reinterpret_cast<const double*>(values);
  const __m256 a = _mm256_castpd_ps(_mm256_i32gather_pd(pairs, _mm256_castsi256_si128(places), 4));
  const __m256 b = _mm256_castpd_ps(_mm256_i32gather_pd(pairs, _mm256_extracti128_si256(places, 1), 4));
  return {Floats(_mm256_shuffle_ps(a, b, 0x88)), Floats(_mm256_shuffle_ps(a, b, 0xdd))};
#else
  return {gather(values, at), gather(values, at + 1)};
#endif
}

inline real load(const float* values) {
  Floats lanes;
  __builtin_memcpy(&lanes, values, sizeof lanes);
  return lanes;
}
inline void store(real a, float* values) { __builtin_memcpy(values, &a.v, sizeof a.v); }

struct real4 {
  real x, y, z, w;
};
inline real4 operator+(const real4& a, const real4& b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }

#if MENISCUS_LANES == 8 && defined(__x86_64__)
/// Transposes four packets: each half of a packet is a row of a matrix before, and a column after.
inline void turn(__m256 (&rows)[4]) {
  const __m256 a = _mm256_unpacklo_ps(rows[0], rows[1]), b = _mm256_unpackhi_ps(rows[0], rows[1]);
  const __m256 c = _mm256_unpacklo_ps(rows[2], rows[3]), d = _mm256_unpackhi_ps(rows[2], rows[3]);
  rows[0] = _mm256_shuffle_ps(a, c, 0x44);
  rows[1] = _mm256_shuffle_ps(a, c, 0xee);
  rows[2] = _mm256_shuffle_ps(b, d, 0x44);
  rows[3] = _mm256_shuffle_ps(b, d, 0xee);
}
#endif

/// Loads kLanes vectors: rows of four, each `pitch` vectors after the previous one.
inline real4 load(const glm::vec4* values, std::ptrdiff_t pitch = 4) {
#if MENISCUS_LANES == 8 && defined(__x86_64__)
  __m256 rows[4];
  for (int n = 0; n < 4; ++n)
    rows[n] =
        _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(&values[n].x)), _mm_loadu_ps(&values[n + pitch].x), 1);
  turn(rows);
  return {Floats(rows[0]), Floats(rows[1]), Floats(rows[2]), Floats(rows[3])};
#else
  real4 result;
  for (int n = 0; n < kLanes; ++n) {
    const glm::vec4& value = values[n / 4 * pitch + n % 4];
    result.x.v[n] = value.x;
    result.y.v[n] = value.y;
    result.z.v[n] = value.z;
    result.w.v[n] = value.w;
  }
  return result;
#endif
}
inline void store(const real4& a, glm::vec4* values, std::ptrdiff_t pitch = 4) {
#if MENISCUS_LANES == 8 && defined(__x86_64__)
  __m256 rows[4] = {a.x.v, a.y.v, a.z.v, a.w.v};
  turn(rows);
  for (int n = 0; n < 4; ++n) {
    _mm_storeu_ps(&values[n].x, _mm256_castps256_ps128(rows[n]));
    _mm_storeu_ps(&values[n + pitch].x, _mm256_extractf128_ps(rows[n], 1));
  }
#else
  for (int n = 0; n < kLanes; ++n)
    values[n / 4 * pitch + n % 4] = glm::vec4(lane(a.x, n), lane(a.y, n), lane(a.z, n), lane(a.w, n));
#endif
}

}  // namespace meniscus::MENISCUS_LANE_NAMESPACE
