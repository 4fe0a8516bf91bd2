// SPDX-License-Identifier: BSD-3-Clause
// The data that host and kernels exchange, as C++: parameters, records, and constants that both share.
//
// A parameters.glsl of gpu_shaders/ declares each of them once. A kernel has them as `layout(std140, binding =
// ...) uniform Parameters { ... params; }`, and Program::set() passes one as a whole. So a wrong name does not compile,
// and a forgotten block is an error. (With single uniforms neither was noticed; and zink, which makes variants of
// kernels for their values, started variants for earlier values: Mesa 22.3.) The order alone puts the members where
// std140 (OpenGL 4.5, section 7.6.2.2) requires them: vectors of doubles first, then of three floats followed by one
// more, then of two, then single ones. Tests query the driver for their offsets.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace meniscus::kernel {

using uint = std::uint32_t;
using glm::dvec3;
using glm::ivec2;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

#include "gpu_shaders/look/parameters.glsl"
#include "gpu_shaders/ray_cast/parameters.glsl"
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/shared/parameters.glsl"

static_assert(sizeof(ProbeRecord) == 64 && sizeof(SideRecord) == 64 && sizeof(CuspArcRecord) == 48,
              "std430 has these sizes");

}  // namespace meniscus::kernel
