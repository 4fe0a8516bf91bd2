// SPDX-License-Identifier: BSD-3-Clause
// The amounts by which radii grow: at each scale another draw.
#include "core/surface/tie_ladder.h"

#include <cmath>

#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

double tie_growth(int attempt) { return attempt == 0 ? 0.0 : 1e-8 * std::pow(3.0, attempt - 1); }

std::vector<Ball> grown_balls(std::span<const Ball> balls, int attempt) {
  std::vector<Ball> grown(balls.begin(), balls.end());
  if (attempt == 0) return grown;
  for (std::size_t n = 0; n < grown.size(); ++n)
    grown[n].radius += 0.5 * tie_growth(attempt) * (1 + scattered(n + 0x10001u * static_cast<std::size_t>(attempt)));
  return grown;
}

}  // namespace meniscus
