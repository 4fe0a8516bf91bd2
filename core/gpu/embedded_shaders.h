// SPDX-License-Identifier: BSD-3-Clause
// The shader files of gpu_shaders/, compiled into the library.
#pragma once

#include <span>
#include <string_view>

namespace meniscus {

struct EmbeddedShader {
  std::string_view path;  ///< from the repository root: "gpu_shaders/..."
  std::string_view text;
};

/// All shaders, sorted by path.
std::span<const EmbeddedShader> embedded_shaders();

}  // namespace meniscus
