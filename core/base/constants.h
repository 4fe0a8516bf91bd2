// SPDX-License-Identifier: BSD-3-Clause
// Constants that everything shares: the index that means none, and the units of other programs' files.
#pragma once

#include <cstdint>
#include <limits>

namespace meniscus {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

inline constexpr double kAngstromPerNanometre = 10.0;

}  // namespace meniscus
