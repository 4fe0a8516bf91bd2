// SPDX-License-Identifier: BSD-3-Clause
// Whether this build has AddressSanitizer, with which limits of address space mean nothing: it maps terabytes, and
// keeps what was freed.
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

}  // namespace meniscus::test
