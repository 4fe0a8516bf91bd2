// SPDX-License-Identifier: BSD-3-Clause
// Whether this build has AddressSanitizer, and what is different then. Limits of address space mean nothing: it maps
// terabytes, and keeps what was freed. And whatever runs takes many times as long.
#pragma once

namespace meniscus::test {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#else
inline constexpr bool kSanitized = false;
#endif

/// So many random samples, or a quarter of them with sanitizers: these look at how each is computed. That all of them
/// come out right is shown where they are cheap, without sanitizers.
constexpr int samples(int count) { return kSanitized ? (count + 3) / 4 : count; }

}  // namespace meniscus::test
