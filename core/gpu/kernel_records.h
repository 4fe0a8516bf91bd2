// SPDX-License-Identifier: BSD-3-Clause
// The records that kernels and the host hand to each other, and the numbers that both must say alike, as C++.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace meniscus::kernel {

using uint = std::uint32_t;
using glm::dvec3;
using glm::uvec4;
using glm::vec4;

#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/shared/probe_record.glsl"
#include "gpu_shaders/singularities/records.glsl"

static_assert(sizeof(ProbeRecord) == 64 && sizeof(SideRecord) == 64 && sizeof(CuspArcRecord) == 48,
              "std430 has these sizes");

}  // namespace meniscus::kernel
