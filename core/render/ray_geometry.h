// SPDX-License-Identifier: BSD-3-Clause
// The ray caster's geometry functions, compiled for C++ in double precision: the same formulas as on the GPU.
#pragma once

#include "core/math/double_geometry.h"

namespace meniscus::geometry {

// The types of gpu_shaders/reduced_surface/precision.glsl, for one ray at a time.
using truth = bool;
using integer = int;
template <typename T>
T select(bool condition, T yes, T no) {
  return condition ? yes : no;
}
inline bool some(bool condition) { return condition; }

#include "gpu_shaders/geometry/patch_membership.glsl"
#include "gpu_shaders/geometry/ray_shapes.glsl"
#include "gpu_shaders/geometry/torus_hits.glsl"

}  // namespace meniscus::geometry
