// SPDX-License-Identifier: BSD-3-Clause
// The default radius of the probe.
#pragma once

namespace meniscus {

inline constexpr double kUsualProbe = 1.4;  ///< Å, a water molecule

}  // namespace meniscus
