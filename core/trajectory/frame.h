// SPDX-License-Identifier: BSD-3-Clause
// One moment of a trajectory.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

struct Frame {
  std::vector<glm::dvec3> positions;  ///< Å, one per atom of the file, in its order
  std::optional<glm::dmat3> cell;     ///< columns: the vectors a, b, c of the periodic box in Å; none: no box
  std::optional<double> time;         ///< ps
  std::optional<std::int64_t> step;   ///< of the simulation
};

}  // namespace meniscus
