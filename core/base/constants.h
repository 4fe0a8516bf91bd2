// SPDX-License-Identifier: BSD-3-Clause
// Constants that all modules share: the index that means none, and ångströms per nanometre.
#pragma once

#include <cstdint>
#include <limits>

namespace meniscus {

/// The index that means that there is none.
inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

inline constexpr double kAngstromPerNanometre = 10.0;

}  // namespace meniscus
