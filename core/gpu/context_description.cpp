// SPDX-License-Identifier: BSD-3-Clause
// Questions to the current GL context: its names, and whether it still lives.
#include "core/gpu/context_description.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <epoxy/gl.h>

#include "core/base/error.h"

namespace meniscus {
namespace {

std::string gl_text(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text ? text : "unknown";
}

}  // namespace

bool is_software_renderer(std::string renderer) {
  std::ranges::transform(renderer, renderer.begin(), [](unsigned char c) { return std::tolower(c); });
  // Zink and others name the device below them in parentheses, such as "zink (llvmpipe (LLVM 15.0.6, 256 bits))".
  return renderer.starts_with("swr ") ||
         std::ranges::any_of(
             std::array{"llvmpipe", "lavapipe", "softpipe", "swrast", "swiftshader", "software", "basic render"},
             [&](const char* word) { return renderer.find(word) != std::string::npos; });
}

ContextDescription describe_current_context() {
  ContextDescription description;
  description.vendor = gl_text(GL_VENDOR);
  description.renderer = gl_text(GL_RENDERER);
  description.version = gl_text(GL_VERSION);
  description.software = is_software_renderer(description.renderer);
  return description;
}

void require_living_context() {
  if (glGetGraphicsResetStatus() != GL_NO_ERROR)
    throw GpuError("the GPU was reset and took the picture with it; start again, with a smaller molecule if it recurs");
}

}  // namespace meniscus
