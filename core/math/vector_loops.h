// SPDX-License-Identifier: BSD-3-Clause
// Loops that compilers turn into vector instructions: macros for wider units, numbers ordered by their bits, and a list
// of the negative entries of an array.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

// Compiles a function for wider vector units, too. The results are the same: products and sums are never fused
// (-ffp-contract=off), and quotients and roots are rounded alike in every width. clang 14 has no such clones, so that
// its loops stay as wide as the baseline's.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define MENISCUS_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default"), flatten))
#else
#define MENISCUS_VECTOR_CLONES
#endif

// Tells gcc that the steps of the following loop are independent: no step writes data that another step reads. clang
// finds this out by itself, and warns about the pragma where sanitizers keep it from vectorizing.
#if defined(__GNUC__) && !defined(__clang__)
#define MENISCUS_INDEPENDENT_STEPS _Pragma("GCC ivdep")
#else
#define MENISCUS_INDEPENDENT_STEPS
#endif

namespace meniscus {

/// Converts a number that is not negative to an integer and back. The integers have the same order as the numbers.
inline std::int64_t ordered_bits(double number) { return std::bit_cast<std::int64_t>(number); }
inline double from_ordered_bits(std::int64_t bits) { return std::bit_cast<double>(bits); }

}  // namespace meniscus

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace meniscus {

namespace detail {

struct SetBits {
  std::array<std::array<std::uint8_t, 8>, 256>
      place{};  // for each byte the places of its bits that are set, in ascending order
  std::array<std::uint8_t, 256> count{};
};

constexpr SetBits list_set_bits() {
  SetBits bits;
  for (std::size_t byte = 0; byte < 256; ++byte)
    for (std::uint8_t n = 0; n < 8; ++n)
      if (byte >> n & 1) bits.place[byte][bits.count[byte]++] = n;
  return bits;
}

inline constexpr SetBits kSetBits = list_set_bits();

// Writes at + place[k] for k < 8. Compilers do not vectorize the plain loop, because bytes might alias the list.
inline void write_eight(std::uint32_t at, const std::array<std::uint8_t, 8>& place, std::uint32_t* list) {
#if defined(__SSE2__)
  const __m128i none = _mm_setzero_si128(), base = _mm_set1_epi32(static_cast<int>(at));
  const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(place.data()));
  const __m128i shorts = _mm_unpacklo_epi8(bytes, none);
  auto* to = reinterpret_cast<__m128i*>(list);
  _mm_storeu_si128(to, _mm_add_epi32(base, _mm_unpacklo_epi16(shorts, none)));
  _mm_storeu_si128(to + 1, _mm_add_epi32(base, _mm_unpackhi_epi16(shorts, none)));
#else
  for (std::size_t k = 0; k < 8; ++k) list[k] = at + place[k];
#endif
}

}  // namespace detail

/// Returns a byte of which bit n is set if the n-th of these eight numbers is negative.
inline unsigned negative_of_eight(const std::int16_t* numbers) {
#if defined(__SSE2__)
  const __m128i eight = _mm_loadu_si128(reinterpret_cast<const __m128i*>(numbers));
  return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(eight, _mm_setzero_si128())));
#else
  unsigned bits = 0;
  for (unsigned n = 0; n < 8; ++n) bits |= static_cast<unsigned>(numbers[n] < 0) << n;
  return bits;
#endif
}

inline unsigned negative_of_eight(const std::int64_t* numbers) {
#if defined(__SSE2__)
  const auto two = [&](std::size_t n) {
    return _mm_castsi128_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(numbers + n)));
  };
  const auto upper_halves = [&](std::size_t n) { return _mm_shuffle_ps(two(n), two(n + 2), _MM_SHUFFLE(3, 1, 3, 1)); };
  return static_cast<unsigned>(_mm_movemask_ps(upper_halves(0)) | _mm_movemask_ps(upper_halves(4)) << 4);
#else
  unsigned bits = 0;
  for (unsigned n = 0; n < 8; ++n) bits |= static_cast<unsigned>(numbers[n] < 0) << n;
  return bits;
#endif
}

/// Appends first + n to the list for each negative number n of `count`, and returns the new end of the list. Both
/// arrays must have room up to a multiple of eight entries. The entries after their ends may be read and overwritten.
template <typename Number>
std::uint32_t* list_negative(const Number* numbers, std::size_t count, std::uint32_t first, std::uint32_t* list) {
  for (std::size_t n = 0; n < count; n += 8) {
    unsigned bits = negative_of_eight(numbers + n);
    if (count - n < 8) bits &= (1u << (count - n)) - 1;
    const std::uint32_t at = first + static_cast<std::uint32_t>(n);
    detail::write_eight(at, detail::kSetBits.place[bits], list);
    list += detail::kSetBits.count[bits];
  }
  return list;
}

}  // namespace meniscus
