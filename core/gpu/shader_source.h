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

/// Gives the text of a path such as "gpu_shaders/geometry/ray_torus.glsl"; nothing if there is no such file.
using ShaderFinder = std::function<std::optional<std::string_view>(std::string_view path)>;

/// A shader with its includes put in place.
struct ShaderSource {
  std::string text;
  std::vector<std::string> files;  ///< file of each source number that the #line directives in `text` use
};

/// Replaces each line `#include "gpu_shaders/..."` by the file it names (each file once), and puts `defines` after the
/// `#version` line, which only the entry file has. Block comments are not looked at.
/// Throws GpuError with "file:line:" when a file is missing, includes itself, or the entry has no #version.
ShaderSource expand_shader(std::string_view path, const ShaderFinder& find, const ShaderDefines& defines = {});

/// The same for a kernel compiled into the library, with gpu_shaders/shared/finished_groups.glsl behind it: its own
/// main() is called from there.
ShaderSource expand_embedded_shader(std::string_view path, const ShaderDefines& defines = {});

/// Rewrites the positions in a compiler's log ("0:12(5):" of Mesa, "0(12) :" of NVIDIA, "ERROR: 0:12:" of the
/// reference compiler) as "file:12:".
std::string translate_shader_log(std::string_view log, const std::vector<std::string>& files);

struct EmbeddedShader {
  std::string_view path;  ///< from the repository root: "gpu_shaders/..."
  std::string_view text;
};

/// All shaders, sorted by path.
std::span<const EmbeddedShader> embedded_shaders();

}  // namespace meniscus
