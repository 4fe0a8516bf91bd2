// SPDX-License-Identifier: BSD-3-Clause
// Compute kernels: compiled from the embedded shaders, kept for reuse, started with any number of groups.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/gpu/buffer.h"
#include "core/gpu/shader_source.h"

namespace meniscus {

/// One linked compute kernel. Needs a current EglContext, which hears of all that is started (work_proof.h). Setting a
/// uniform that the compiler removed does nothing.
class Program {
 public:
  /// path: "gpu_shaders/<stage>/<name>.comp". Throws GpuError with the compiler's log, in terms of our files.
  explicit Program(std::string_view path, const ShaderDefines& defines = {});
  Program(std::string_view path, const ShaderSource& source);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void set(const char* uniform, std::int32_t value) const;
  void set(const char* uniform, std::uint32_t value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, double value) const;
  void set(const char* uniform, const glm::dvec3& value) const;
  void set(const char* uniform, const glm::vec2& value) const;
  void set(const char* uniform, const glm::vec3& value) const;
  void set(const char* uniform, const glm::vec4& value) const;
  void set(const char* uniform, const glm::ivec2& value) const;
  void set(const char* uniform, const glm::uvec2& value) const;

  /// Starts `group_count` groups; more than the driver takes along x are folded into a rectangle, so that kernels must
  /// use linear_group_index() of gpu_shaders/shared/linear_index.glsl and ignore what is past the end.
  /// A full barrier for storage follows. `longest_row` is for tests: 0 means the driver's limit.
  void dispatch(std::size_t group_count, std::uint32_t longest_row = 0) const;
  /// Groups in a plane, without folding.
  void dispatch_2d(std::uint32_t x, std::uint32_t y) const;
  /// Group counts {x, y, z} as three uint32 in `counts` at `byte_offset`, written by an earlier kernel.
  void dispatch_indirect(const Buffer& counts, std::size_t byte_offset = 0) const;

 private:
  int location(const char* uniform) const;
  void finish() const;

  std::string path_;
  std::uint32_t name_ = 0;
};

/// Groups of 64 invocations, the usual local size of a kernel.
constexpr std::size_t group_count(std::size_t invocations) { return (invocations + 63) / 64; }

/// Compiles each pair of path and defines once.
class ProgramCache {
 public:
  const Program& get(const std::string& path, const ShaderDefines& defines = {});

 private:
  std::map<std::pair<std::string, ShaderDefines>, std::unique_ptr<Program>> programs_;
};

}  // namespace meniscus
