// SPDX-License-Identifier: BSD-3-Clause
// All the forms in which a kernel is compiled.
#pragma once

#include <string_view>
#include <vector>

#include "core/gpu/shader_source.h"

namespace meniscus {

/// Without any define, for each pass, and with each switch that the kernel or its includes ask for.
std::vector<ShaderDefines> variants_of(const EmbeddedShader& shader);

}  // namespace meniscus
