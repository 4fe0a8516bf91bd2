// SPDX-License-Identifier: BSD-3-Clause
// Constants and units that all modules share: the index that means none, ångströms per nanometre, the radius of water
// as a probe, and the unit of a run's times.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace meniscus {

/// The index that means that there is none.
inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

inline constexpr double kAngstromPerNanometre = 10.0;

inline constexpr double kUsualProbe = 1.4;  ///< Å, a water molecule

struct TimeUnit {
  const char* name;
  double picoseconds;
};

/// Returns the unit for a trajectory whose longest time is `longest` ps: ps below 1 ns, ns below 1 µs, else µs.
inline TimeUnit time_unit(double longest) {
  if (std::abs(longest) < 1e3) return {"ps", 1.0};
  return std::abs(longest) < 1e6 ? TimeUnit{"ns", 1e3} : TimeUnit{"µs", 1e6};
}

}  // namespace meniscus
