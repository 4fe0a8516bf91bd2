// SPDX-License-Identifier: BSD-3-Clause
// How much of the sky points of a surface see: ambient occlusion as numbers.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

struct Surface;

/// Rays into the hemisphere of a point that its number is made of, unless others are asked for. Against 10,000 rays
/// drawn by lot at 1,000 points of 1UBQ the error is 0.008 (rms), at most 0.03: tests/image/light_test.cpp.
inline constexpr std::size_t kSkyRays = 256;

/// Points and the normals there, of length 1, towards the solvent; as many of both.
struct SkyPoints {
  std::span<const glm::dvec3> positions;  ///< Å, on the surface
  std::span<const glm::dvec3> normals;
};

/// For each point the share, in [0, 1], of the sky above its normal that it sees past the whole surface, however far
/// away: each direction weighs as much as the cosine of its angle to the normal. 1 on a ball alone, 0 in a cavity.
/// directions: towards the sky, of length 1, all over the sphere, the same for every point; nothing: 2 * kSkyRays of
/// sky_directions().
std::vector<float> sky_visibility(const Surface& surface, const SkyPoints& points,
                                  std::span<const glm::vec3> directions = {});

}  // namespace meniscus
