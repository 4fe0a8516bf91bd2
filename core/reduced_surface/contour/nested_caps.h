// SPDX-License-Identifier: BSD-3-Clause
// Finds balls around a first ball that can be left out, because others cover everything that they cover of its sphere.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/reduced_surface/contour/blockers.h"

namespace meniscus {

/// Finds the balls whose caps of the first ball's sphere surely lie within the caps of others. Such a ball's circle is
/// covered, and it ends no arc of another circle. Reused from sphere to sphere to save allocations.
class NestedCaps {
 public:
  /// Returns, per blocker, 1 if it can be left out. Each is compared only with the widest caps, so that the time is
  /// nearly proportional to the number of balls, and 0 proves nothing.
  const std::vector<std::uint8_t>& find(const Blockers& blockers);

 private:
  struct Cap {
    std::uint32_t ball;
    glm::dvec3 axis;
    double cosine, sine;
    double blur;  ///< radians: the possible error of its border
  };

  std::vector<Cap> caps_, widest_;
  std::vector<std::uint8_t> nested_;
};

}  // namespace meniscus
