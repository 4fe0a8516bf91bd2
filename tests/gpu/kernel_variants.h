// SPDX-License-Identifier: BSD-3-Clause
// Returns all the forms in which a kernel is compiled.
#pragma once

#include <string_view>
#include <vector>

#include "core/gpu/shader_source.h"

namespace meniscus {

/// Returns the variants without defines, for each pass, and with each switch that the kernel or its includes use.
std::vector<ShaderDefines> variants_of(const EmbeddedShader& shader);

}  // namespace meniscus
