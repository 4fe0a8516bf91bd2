// SPDX-License-Identifier: BSD-3-Clause
// Tells whether a coloring hides some atoms or lets light through them.
#include "core/color/coloring.h"

#include <algorithm>

namespace meniscus {

bool Coloring::hides_some() const {
  return std::ranges::find(hidden, true) != hidden.end() || std::ranges::find(opacity, 0.0f) != opacity.end();
}

bool Coloring::is_translucent() const {
  return std::ranges::any_of(opacity, [](float share) { return share > 0.0f && share < 1.0f; });
}

}  // namespace meniscus
