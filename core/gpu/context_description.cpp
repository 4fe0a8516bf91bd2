// SPDX-License-Identifier: BSD-3-Clause
// Queries a GL context for its renderer, its versions and its limits.
#include "core/gpu/context_description.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <epoxy/gl.h>
#include <fmt/format.h>

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
    throw GpuError(
        "the GPU was reset, and the picture is lost; run again, with a smaller molecule if this happens again");
}

namespace {

std::uint32_t integer_limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return static_cast<std::uint32_t>(std::max(value, 0));
}

}  // namespace

GpuLimits query_gpu_limits() {
  GpuLimits limits;
  GLint64 block_bytes = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block_bytes);
  limits.storage_block_bytes = static_cast<std::size_t>(block_bytes);
  GLint x = 0, y = 0;
  glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &x);
  glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 1, &y);
  limits.group_count = static_cast<std::uint32_t>(std::min(x, y));
  limits.storage_blocks = integer_limit(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS);
  limits.shared_bytes = integer_limit(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE);
  limits.group_size = integer_limit(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS);
  check_gl("asking for limits");
  return limits;
}

void check_gl(const char* what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  if (error == GL_CONTEXT_LOST) require_living_context();
  if (error == GL_OUT_OF_MEMORY) throw CapacityError("the GPU ran out of memory while {}", what);
  throw GpuError("GL error 0x{:04x} while {}", error, what);
}

}  // namespace meniscus
