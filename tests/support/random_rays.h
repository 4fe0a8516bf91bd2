// SPDX-License-Identifier: BSD-3-Clause
// Random rays near random tori, for tests of the ray caster's geometry on every device.
#pragma once

#include <random>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace meniscus::testing {

/// A ray that starts within a few Å of a torus around z; all numbers fit single precision exactly.
struct TorusQuery {
  glm::dvec3 origin{0.0}, direction{0.0};
  double major = 0.0, minor = 0.0;
};

inline TorusQuery random_torus_query(std::mt19937& random) {
  std::uniform_real_distribution<float> position(-3.0f, 3.0f), radius(0.05f, 4.0f);
  std::normal_distribution<float> normal;
  const glm::vec3 direction = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
  const glm::vec3 through(position(random), position(random), position(random));
  TorusQuery query;
  query.origin = through - direction * glm::dot(through, direction);
  query.direction = direction;
  query.major = radius(random);
  query.minor = radius(random);
  return query;
}

}  // namespace meniscus::testing
