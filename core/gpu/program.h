// SPDX-License-Identifier: BSD-3-Clause
// Compute kernels: compiled from the embedded shaders, cached, started with any number of groups, and timed in stages.
#pragma once

#include <map>
#include <memory>

#include "core/base/progress.h"
#include "core/gpu/buffer.h"
#include "core/gpu/shader_source.h"

namespace meniscus {

/// One linked compute kernel. An EglContext must be current; its WorkProof counts all groups (work_proof.h). The
/// parameters are uniform blocks; all of them must be set before a dispatch.
class Program {
 public:
  /// path: "gpu_shaders/<stage>/<name>.comp". Throws GpuError with the compiler's log, in terms of our files.
  explicit Program(std::string_view path, const ShaderDefines& defines = {});
  Program(std::string_view path, const ShaderSource& source);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Sets a uniform block from one of the structs of kernel_records.h; it stays set until the next call. Throws
  /// GpuError if the kernel has no block at this binding, or one of another size.
  template <typename T>
  void set(const T& parameters, int binding = 0) const {
    static_assert(std::is_trivially_copyable_v<T> && std::is_standard_layout_v<T>);
    set_block(binding, &parameters, sizeof parameters);
  }

  /// Starts `group_count` groups. Counts above the driver's limit along x are folded into a rectangle, so kernels must
  /// use linear_group_index() of gpu_shaders/shared/dispatch.glsl and ignore indices past the end. A full barrier for
  /// storage follows. longest_row: for tests; 0: the driver's limit. Throws GpuError if a block was never set.
  void dispatch(std::size_t group_count, std::uint32_t longest_row = 0) const;
  /// Starts groups in a plane, without folding.
  void dispatch_2d(std::uint32_t x, std::uint32_t y) const;
  /// Starts groups {x, y, z}, read as three uint32 in `counts` at `byte_offset` that an earlier kernel wrote.
  void dispatch_indirect(const Buffer& counts, std::size_t byte_offset = 0) const;

 private:
  /// The host's copy of a uniform block.
  struct Block {
    std::uint32_t binding = 0;
    std::uint32_t buffer = 0;        ///< GL name; 0 if it was never set
    std::vector<std::byte> content;  ///< its length is that of the kernel's block
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

/// Returns the number of groups of 64 invocations, the usual local size of a kernel.
constexpr std::size_t group_count(std::size_t invocations) { return (invocations + 63) / 64; }

/// Compiles each pair of path and defines once.
class ProgramCache {
 public:
  const Program& get(const std::string& path, const ShaderDefines& defines = {});

 private:
  std::map<std::pair<std::string, ShaderDefines>, std::unique_ptr<Program>> programs_;
};

/// A stage on the GPU, which lasts as long as this object. If the clock requires exact times, the GPU is idle at both
/// ends, so that the host's clock is right: GL's own timer queries stay at zero for compute work on llvmpipe (Mesa
/// 22.3). A GL context must be current.
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
