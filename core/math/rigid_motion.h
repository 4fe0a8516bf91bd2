// SPDX-License-Identifier: BSD-3-Clause
// A rigid motion, which places a copy of a molecule, and a superposition of two molecules.
#pragma once

#include <cstddef>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

/// The motion x -> rotation * x + translation. The rotation is orthonormal with determinant +1: a mirror image is no
/// rigid motion.
struct RigidMotion {
  glm::dmat3 rotation{1.0};
  glm::dvec3 translation{0.0};  ///< Å

  glm::dvec3 operator()(const glm::dvec3& x) const { return rotation * x + translation; }
};

/// A rigid motion that superposes pairs of points.
struct Superposition {
  RigidMotion motion;
  std::size_t atoms = 0;  ///< number of pairs
  double rmsd = 0.0;      ///< root mean square distance of the pairs after the motion, Å
};

}  // namespace meniscus
