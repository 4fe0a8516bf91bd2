// SPDX-License-Identifier: BSD-3-Clause
// Largest and smallest numbers as those of integers, which loops over vectors find whatever the order.
#pragma once

#include <bit>
#include <cstdint>

namespace meniscus {

/// Numbers that are not negative stand in the same order as their bits.
inline std::int64_t ordered_bits(double number) { return std::bit_cast<std::int64_t>(number); }
inline double from_ordered_bits(std::int64_t bits) { return std::bit_cast<double>(bits); }

}  // namespace meniscus
