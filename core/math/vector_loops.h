// SPDX-License-Identifier: BSD-3-Clause
// Macros for loops that compilers vectorize, and numbers whose minimum and maximum such loops find in any order.
#pragma once

#include <bit>
#include <cstdint>

// Compiles a function for wider vector units, too. The results are the same: products and sums are never fused
// (-ffp-contract=off), and quotients and roots are rounded alike in every width. clang 14 has no such clones, so that
// its loops stay as wide as the baseline's.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define MENISCUS_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default"), flatten))
#else
#define MENISCUS_VECTOR_CLONES
#endif

// Stands before a loop of which no step writes what another step reads. clang finds that out by itself, and it warns
// about such a pragma where sanitizers keep it from vectorizing.
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
