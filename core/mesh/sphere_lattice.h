// SPDX-License-Identifier: BSD-3-Clause
// Evenly spread directions: a subdivided icosahedron.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

/// Unit directions and the counter-clockwise triangles between them (seen from outside).
struct SphereLattice {
  std::vector<glm::dvec3> directions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Each edge of the icosahedron in `frequency` >= 1 parts: 10 frequency^2 + 2 directions.
SphereLattice sphere_lattice(int frequency);

/// The smallest frequency whose edges are all at most `angle` radian long.
int lattice_frequency(double angle);

}  // namespace meniscus
