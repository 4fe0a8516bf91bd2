// SPDX-License-Identifier: BSD-3-Clause
// Compute kernels: compiled from the embedded shaders, kept for reuse, started with any number of groups, timed in
// stages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/base/stage_clock.h"
#include "core/gpu/buffer.h"
#include "core/gpu/shader_source.h"

namespace meniscus {

/// One linked compute kernel. Needs a current EglContext, which hears of all that is started (work_proof.h). Its
/// parameters are uniform blocks; it cannot be started before all of them are set.
class Program {
 public:
  /// path: "gpu_shaders/<stage>/<name>.comp". Throws GpuError with the compiler's log, in terms of our files.
  explicit Program(std::string_view path, const ShaderDefines& defines = {});
  Program(std::string_view path, const ShaderSource& source);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Sets a uniform block, given as one of the structs of kernel_parameters.h; it stays until it is set again. Throws
  /// GpuError if the kernel has no block at this binding, or one of another size.
  template <typename T>
  void set(const T& parameters, int binding = 0) const {
    static_assert(std::is_trivially_copyable_v<T> && std::is_standard_layout_v<T>);
    set_block(binding, &parameters, sizeof parameters);
  }

  /// Starts `group_count` groups; more than the driver takes along x are folded into a rectangle, so that kernels must
  /// use linear_group_index() of gpu_shaders/shared/linear_index.glsl and ignore what is past the end.
  /// A full barrier for storage follows. `longest_row` is for tests: 0 means the driver's limit.
  /// Throws GpuError if a block was never set.
  void dispatch(std::size_t group_count, std::uint32_t longest_row = 0) const;
  /// Groups in a plane, without folding.
  void dispatch_2d(std::uint32_t x, std::uint32_t y) const;
  /// Group counts {x, y, z} as three uint32 in `counts` at `byte_offset`, written by an earlier kernel.
  void dispatch_indirect(const Buffer& counts, std::size_t byte_offset = 0) const;

 private:
  /// What the host knows of a uniform block.
  struct Block {
    std::uint32_t binding = 0;
    std::uint32_t buffer = 0;        ///< GL name; 0: never set
    std::vector<std::byte> content;  ///< as many bytes as the kernel sees
  };

  void compile(const ShaderSource& source);
  void find_blocks();
  void set_block(int binding, const void* bytes, std::size_t byte_count) const;
  void start() const;
  void finish() const;

  std::string path_;
  std::uint32_t name_ = 0;
  mutable std::vector<Block> blocks_;
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

/// Lasts as long as the stage. If the clock asks for exact times the GPU is idle at both ends, so that the host's clock
/// is right: GL's own timer queries stay at zero for compute work on llvmpipe (Mesa 22.3). Needs a current context.
class GpuStage {
 public:
  GpuStage(StageClock& clock, const std::string& name);
  ~GpuStage();
  GpuStage(const GpuStage&) = delete;
  GpuStage& operator=(const GpuStage&) = delete;

 private:
  bool waits_;
  std::optional<StageClock::Stage> stage_;
};

}  // namespace meniscus
