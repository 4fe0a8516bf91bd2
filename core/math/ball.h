// SPDX-License-Identifier: BSD-3-Clause
// The ball that represents an atom in the computation of a surface.
#pragma once

#include <glm/vec3.hpp>

namespace meniscus {

/// A van der Waals ball. Its centre and its radius r_i are in Å.
struct Ball {
  glm::dvec3 center{0.0};
  double radius = 0.0;
};

}  // namespace meniscus
