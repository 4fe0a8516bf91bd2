// SPDX-License-Identifier: BSD-3-Clause
// Random points on the patches of a surface by their tables alone: quadric or torus, and the planes that clip it.
//
// Written from the comments of core/surface/primitives.h as a ray caster or exporter would; the boundary
// representation is not looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus::testing {

/// A uniformly random point of a patch's whole sphere or torus.
struct PatchSample {
  glm::dvec3 point{0.0};
  bool inside = false;     ///< on the patch by its planes
  double clearance = 0.0;  ///< Å to the nearest border if inside, else to the clip it violates most
};

std::size_t patch_count(const Surface& surface, PatchKind kind);
/// Returns the area of the whole sphere or torus in Å² (a spindle includes the part past the axis).
double whole_area(const Surface& surface, PatchKind kind, std::uint32_t patch);
/// Returns the area of the patch's faces in Å².
double face_area(const Surface& surface, PatchKind kind, std::uint32_t patch);
PatchSample sample_patch(const Surface& surface, PatchKind kind, std::uint32_t patch, std::mt19937& random);
/// Samples a toroidal patch together with all others on its circle.
PatchSample sample_circle(const Surface& surface, std::uint32_t patch, std::mt19937& random);
/// Tests a given point of a spherical patch's sphere.
bool inside_planes(const Surface& surface, PatchKind kind, std::uint32_t patch, const glm::dvec3& point);

}  // namespace meniscus::testing
