// SPDX-License-Identifier: BSD-3-Clause
// The radius of the probe where nobody names one.
#pragma once

namespace meniscus {

inline constexpr double kUsualProbe = 1.4;  ///< Å, that of water

}  // namespace meniscus
