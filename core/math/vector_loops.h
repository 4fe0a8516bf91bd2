// SPDX-License-Identifier: BSD-3-Clause
// Loops over vectors: compiled for wider units, too, and minima and maxima that they find in any order.
#pragma once

#include <bit>
#include <cstdint>

// Wider units change nothing in the results: products and sums are never fused (-ffp-contract=off), and a quotient or a
// root is rounded alike in any width. clang 14 has no such clones; its loops stay as wide as the baseline's.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define MENISCUS_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default"), flatten))
#else
#define MENISCUS_VECTOR_CLONES
#endif

// Before a loop of which no step writes what another one reads. clang finds out by itself, and warns of such words
// where sanitizers keep it from making vectors.
#if defined(__GNUC__) && !defined(__clang__)
#define MENISCUS_INDEPENDENT_STEPS _Pragma("GCC ivdep")
#else
#define MENISCUS_INDEPENDENT_STEPS
#endif

namespace meniscus {

/// Numbers that are not negative are in the same order as their bits.
inline std::int64_t ordered_bits(double number) { return std::bit_cast<std::int64_t>(number); }
inline double from_ordered_bits(std::int64_t bits) { return std::bit_cast<double>(bits); }

}  // namespace meniscus
