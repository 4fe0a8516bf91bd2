// SPDX-License-Identifier: BSD-3-Clause
// The index that points at nothing.
#pragma once

#include <cstdint>
#include <limits>

namespace meniscus {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

}  // namespace meniscus
