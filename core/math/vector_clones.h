// SPDX-License-Identifier: BSD-3-Clause
// Marks functions whose loops are compiled for wider vector units, too, and chosen when the program starts.
#pragma once

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
