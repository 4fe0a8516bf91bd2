// SPDX-License-Identifier: BSD-3-Clause
// How much the preview server takes from others.
#pragma once

#include <cstddef>

namespace meniscus {

inline constexpr std::size_t kMostClients = 4;  ///< sockets that look or control
inline constexpr std::size_t kMostConnections = 32;
inline constexpr std::size_t kLargestMessage = 4096;  ///< bytes
inline constexpr std::size_t kLargestHeader = 8192;   ///< bytes of a request's header
inline constexpr int kPatience = 10;                  ///< seconds for a request

}  // namespace meniscus
