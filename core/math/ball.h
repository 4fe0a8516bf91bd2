// SPDX-License-Identifier: BSD-3-Clause
// A ball: what an atom is to a surface.
#pragma once

#include <glm/vec3.hpp>

namespace meniscus {

/// A van der Waals ball: centre and radius r_i, Å.
struct Ball {
  glm::dvec3 center{0.0};
  double radius = 0.0;
};

}  // namespace meniscus
