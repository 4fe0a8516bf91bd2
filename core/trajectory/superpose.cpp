// SPDX-License-Identifier: BSD-3-Clause
// Asks gemmi's quaternion method for the motion.
#include "core/trajectory/superpose.h"
#include "core/math/rigid_motion.h"

#include <vector>

#include <gemmi/qcp.hpp>

namespace meniscus {

RigidMotion superposition(std::span<const glm::dvec3> reference, std::span<const glm::dvec3> positions,
                          std::span<const std::uint32_t> atoms) {
  std::vector<gemmi::Position> target, moved;
  for (const std::uint32_t a : atoms) {
    target.emplace_back(reference[a].x, reference[a].y, reference[a].z);
    moved.emplace_back(positions[a].x, positions[a].y, positions[a].z);
  }
  const gemmi::SupResult best = gemmi::superpose_positions(target.data(), moved.data(), atoms.size(), nullptr);
  const gemmi::Mat33& m = best.transform.mat;
  RigidMotion motion;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) motion.rotation[column][row] = m[row][column];
  motion.translation = {best.transform.vec.x, best.transform.vec.y, best.transform.vec.z};
  return motion;
}

}  // namespace meniscus
