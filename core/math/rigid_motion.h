// SPDX-License-Identifier: BSD-3-Clause
// A rotation and a translation: the position of a copy of a molecule.
#pragma once

#include <cstddef>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

/// x -> rotation * x + translation. The rotation is orthonormal with determinant +1: mirrors are none.
struct RigidMotion {
  glm::dmat3 rotation{1.0};
  glm::dvec3 translation{0.0};  ///< Å

  glm::dvec3 operator()(const glm::dvec3& x) const { return rotation * x + translation; }
};

/// A motion that brings pairs of points together.
struct Superposition {
  RigidMotion motion;
  std::size_t atoms = 0;  ///< pairs
  double rmsd = 0.0;      ///< Å, of the pairs after the motion
};

}  // namespace meniscus
