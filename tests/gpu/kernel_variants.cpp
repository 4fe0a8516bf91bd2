// SPDX-License-Identifier: BSD-3-Clause
// Finds the variants of a kernel by its expanded text.
#include "tests/gpu/kernel_variants.h"

#include <string>

namespace meniscus {

std::vector<ShaderDefines> variants_of(const EmbeddedShader& shader) {
  std::vector<ShaderDefines> variants{{}};
  const std::string text = expand_embedded_shader(shader.path).text;
  for (const char* pass : {"1", "2"})
    if (text.find("#if PASS == " + std::string(pass)) != std::string::npos ||
        (text.find("#if PASS") != std::string::npos && std::string_view(pass) == "1"))
      variants.push_back({{"PASS", pass}});
  for (const char* word : {"LISTED", "RESUMED", "SHADE", "SILHOUETTES", "SOME_HIDDEN", "WHOLE_SPHERES"})
    if (text.find("#ifdef " + std::string(word)) != std::string::npos) variants.push_back({{word, "1"}});
  // Many kernels include precision.glsl for single precision alone.
  if (shader.text.find("#ifdef DOUBLE_PRECISION") != std::string::npos) variants.push_back({{"DOUBLE_PRECISION", "1"}});
  return variants;
}

}  // namespace meniscus
