// SPDX-License-Identifier: BSD-3-Clause
// The ray caster's geometry functions, compiled for C++ in double precision: the same formulas as on the GPU.
#pragma once

#include <cmath>

#include "core/math/geometry.h"

namespace meniscus::geometry {

#include "gpu_shaders/geometry/patch_membership.glsl"
#include "gpu_shaders/geometry/ray_sphere.glsl"
#include "gpu_shaders/geometry/ray_torus.glsl"

}  // namespace meniscus::geometry
