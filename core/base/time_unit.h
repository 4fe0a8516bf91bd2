// SPDX-License-Identifier: BSD-3-Clause
// The unit in which the times of a trajectory are written.
#pragma once

#include <cmath>

namespace meniscus {

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
