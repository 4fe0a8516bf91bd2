# Writes one C++ file that holds the text of every shader below ROOT/gpu_shaders.
# Run as: cmake -DROOT=<repository> -DOUTPUT=<file.cpp> -P embed_shaders.cmake
file(GLOB_RECURSE shaders RELATIVE ${ROOT} ${ROOT}/gpu_shaders/*.glsl ${ROOT}/gpu_shaders/*.comp)
list(SORT shaders)

set(entries "")
foreach(shader IN LISTS shaders)
  file(READ ${ROOT}/${shader} text)
  string(APPEND entries "    {\"${shader}\",\n     R\"shader(${text})shader\"},\n")
endforeach()
list(LENGTH shaders count)

file(WRITE ${OUTPUT}.new "// SPDX-License-Identifier: BSD-3-Clause
// The text of every shader, written by scripts/cmake/embed_shaders.cmake; change the files in gpu_shaders instead.
#include \"core/gpu/embedded_shaders.h\"

#include <array>

namespace meniscus {
namespace {

constexpr std::array<EmbeddedShader, ${count}> kShaders = {{
${entries}}};

}  // namespace

std::span<const EmbeddedShader> embedded_shaders() { return kShaders; }

}  // namespace meniscus
")
file(RENAME ${OUTPUT}.new ${OUTPUT})
