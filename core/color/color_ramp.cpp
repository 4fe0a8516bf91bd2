// SPDX-License-Identifier: BSD-3-Clause
// Looks a place in a map up.
#include "core/color/color_ramp.h"

#include <algorithm>

namespace meniscus {

glm::vec3 ColorRamp::color(double t) const {
  t = std::clamp(t, 0.0, 1.0);
  const auto behind = std::ranges::upper_bound(places, t);
  const std::size_t above =
      std::clamp<std::size_t>(static_cast<std::size_t>(behind - places.begin()), 1, places.size() - 1);
  const auto share = static_cast<float>((t - places[above - 1]) / (places[above] - places[above - 1]));
  return (1.0f - share) * colors[above - 1] + share * colors[above];
}

}  // namespace meniscus
