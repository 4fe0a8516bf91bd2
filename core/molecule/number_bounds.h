// SPDX-License-Identifier: BSD-3-Clause
// Numbers of molecule files that have bounds beside those of positions.
#pragma once

#include <string_view>

namespace meniscus {

/// Largest radius in Å that readers accept.
inline constexpr double kLargestRadius = 1000.0;

/// parse_number of reader.h in single precision; false also beyond its range, where there is infinity only.
bool parse_single(std::string_view field, float& number);

}  // namespace meniscus
