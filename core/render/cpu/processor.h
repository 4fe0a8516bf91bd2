// SPDX-License-Identifier: BSD-3-Clause
// Finds which wide instructions this processor has and the system lets programs use. Not every compiler's runtime has
// the function for it (__builtin_cpu_supports).
#pragma once

#include <cstdint>

#include <cpuid.h>

namespace meniscus {

/// Bits of EBX in leaf 7 of CPUID (Intel, Software Developer's Manual, volume 2A).
inline constexpr unsigned kAvx2 = 1u << 5;
inline constexpr unsigned kAvx512 = 1u << 16 | 1u << 17 | 1u << 30 | 1u << 31;  // F, DQ, BW and VL

/// True if the processor has all of them, and the system saves these registers of threads (`registers`: bits of XCR0).
inline bool processor_has(unsigned wanted, unsigned registers) {
  unsigned a = 0, b = 0, c = 0, d = 0;
  constexpr unsigned kOsSavesVectors = 1u << 27;  // OSXSAVE
  if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & kOsSavesVectors)) return false;
  std::uint32_t kept = 0, upper = 0;
  __asm__ volatile("xgetbv" : "=a"(kept), "=d"(upper) : "c"(0));
  return (kept & registers) == registers && __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b & wanted) == wanted;
}

inline bool processor_has_avx2() { return processor_has(kAvx2, 0x06); }      // registers of 128 and 256 bits
inline bool processor_has_avx512() { return processor_has(kAvx512, 0xe6); }  // registers of 512 bits and masks, too

}  // namespace meniscus
