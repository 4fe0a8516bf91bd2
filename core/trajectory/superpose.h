// SPDX-License-Identifier: BSD-3-Clause
// The rigid motion that brings atoms nearest to where they stand in another frame.
#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

namespace meniscus {

struct RigidMotion;

/// The rotation and translation of `positions` that makes the sum of squared distances of its `atoms` to those of
/// `reference` least (D. L. Theobald, Acta Cryst. A 61, 478, 2005). No mirror image. At least three atoms not in a
/// line, else the rotation about the line is any.
RigidMotion superposition(std::span<const glm::dvec3> reference, std::span<const glm::dvec3> positions,
                          std::span<const std::uint32_t> atoms);

}  // namespace meniscus
