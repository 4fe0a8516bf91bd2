// SPDX-License-Identifier: BSD-3-Clause
// Where the atoms of a preview stand at the frames of a trajectory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/structure/structure.h"

namespace meniscus {

struct TrajectoryPositions {
  std::vector<std::uint64_t> numbers;  ///< of the frames in the trajectory; at least one
  /// Å, one per atom of the structure. Throws InputError for a frame that cannot be read.
  std::function<std::vector<glm::dvec3>(std::size_t frame)> positions;
  /// Instead of positions, where frames have other atoms each; else empty. Likewise.
  std::function<Structure(std::size_t frame)> structure{};
};

}  // namespace meniscus
