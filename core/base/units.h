// SPDX-License-Identifier: BSD-3-Clause
// Units of files that are not this program's.
#pragma once

namespace meniscus {

inline constexpr double kAngstromPerNanometre = 10.0;

}  // namespace meniscus
