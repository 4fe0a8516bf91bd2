// SPDX-License-Identifier: BSD-3-Clause
// Expands an embedded shader file with its includes into one text for GL, and maps a compiler's log back to files.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

/// Name and value of a preprocessor symbol.
using ShaderDefines = std::vector<std::pair<std::string, std::string>>;

/// A function that returns the text of a path such as "gpu_shaders/geometry/ray_torus.glsl"; nothing if it is unknown.
using ShaderFinder = std::function<std::optional<std::string_view>(std::string_view path)>;

/// A shader with its includes expanded.
struct ShaderSource {
  std::string text;
  std::vector<std::string> files;  ///< the file of each source number that the #line directives in `text` use
};

/// Replaces each line `#include "gpu_shaders/..."` by the file (each file once), and puts `defines` after the
/// `#version` line, which only the entry file has. Block comments are not parsed. Throws GpuError with "file:line:" if
/// a file is missing or includes itself, or if the entry has no #version.
ShaderSource expand_shader(std::string_view path, const ShaderFinder& find, const ShaderDefines& defines = {});

/// Expands a kernel compiled into the library and appends gpu_shaders/shared/finished_groups.glsl, which calls the
/// kernel's own main().
ShaderSource expand_embedded_shader(std::string_view path, const ShaderDefines& defines = {});

/// Rewrites the positions in a compiler's log ("0:12(5):" of Mesa, "0(12) :" of NVIDIA, "ERROR: 0:12:" of the
/// reference compiler) as "file:12:".
std::string translate_shader_log(std::string_view log, const std::vector<std::string>& files);

struct EmbeddedShader {
  std::string_view path;  ///< path from the repository root: "gpu_shaders/..."
  std::string_view text;
};

/// Returns all shaders, sorted by path.
std::span<const EmbeddedShader> embedded_shaders();

}  // namespace meniscus
