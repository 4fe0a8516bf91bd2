// SPDX-License-Identifier: BSD-3-Clause
// The shared geometry functions, compiled for C++ in double precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#define GEOMETRY inline
#define GEOMETRY_OUT(type) type&
#define GEOMETRY_INOUT(type) type&

namespace meniscus::geometry {

using uint = std::uint32_t;
using real = double;
using real2 = glm::dvec2;
using real3 = glm::dvec3;
using glm::cross;
using glm::dot;
using glm::length;
using glm::normalize;
using std::abs;
using std::max;
using std::min;
using std::sqrt;

inline constexpr double kUnitRoundoff = 0x1p-53;

#include "gpu_shaders/geometry/circle.glsl"
#include "gpu_shaders/geometry/fixed_probe.glsl"
#include "gpu_shaders/geometry/patch_bounds.glsl"
#include "gpu_shaders/geometry/polygon_reach.glsl"
#include "gpu_shaders/geometry/rolling_arc.glsl"
#include "gpu_shaders/geometry/triple.glsl"

}  // namespace meniscus::geometry
