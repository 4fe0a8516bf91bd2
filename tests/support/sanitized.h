// SPDX-License-Identifier: BSD-3-Clause
// Tells whether this build has AddressSanitizer, and its effects. Limits of address space mean nothing: it maps
// terabytes, and keeps freed memory. Everything takes many times as long.
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

/// Returns a number of random samples, or a quarter of it with sanitizers: these test how each sample is computed.
/// Tests without sanitizers, where samples are cheap, show that all come out right.
constexpr int samples(int count) { return kSanitized ? (count + 3) / 4 : count; }

}  // namespace meniscus::test
