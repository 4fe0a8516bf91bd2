// SPDX-License-Identifier: BSD-3-Clause
// Proves that the GPU did its work: compares the groups that were started with the groups that reached their end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace meniscus {

/// The number of bytes of a word, in which kernels count.
inline constexpr std::size_t kWord = sizeof(std::uint32_t);

/// The count of groups in one GL context. A driver may drop a dispatch, or a part of it, without an error; buffers then
/// keep their old contents, and sums of zeros agree with each other. So each kernel counts its groups at its end
/// (gpu_shaders/shared/finished_groups.glsl), Program adds up the groups that it starts, and results of the GPU are
/// used only if both counts are equal.
class WorkProof {
 public:
  /// Counts for the context current on this thread, and occupies its atomic counter binding 0. Its memory ends with the
  /// context. Throws CapacityError.
  WorkProof();
  ~WorkProof();
  WorkProof(const WorkProof&) = delete;
  WorkProof& operator=(const WorkProof&) = delete;

  /// Returns the count of the EglContext current on this thread. Throws GpuError if there is none.
  static WorkProof& current();
  /// Must be called when its context has been made current on this thread.
  void make_current();

  void started(std::uint32_t groups) { expected_ += groups; }
  /// Adds a group count {x, y, z}, three uint32 that kernels wrote to this GL buffer; it is copied at once, so the
  /// buffer may be overwritten later.
  void started_indirect(std::uint32_t buffer, std::size_t byte_offset);

  /// Words of a buffer that are read together with the counts.
  struct Piece {
    std::uint32_t buffer = 0;  ///< GL name
    std::size_t byte_offset = 0;
    std::span<std::uint32_t> words;
  };
  static constexpr std::size_t kMostPieceWords = 128;  ///< limit for all pieces together

  /// Waits for the GPU, and reads the pieces. Throws GpuError if a started group has not finished, or if the driver has
  /// reset the context; CapacityError if the GPU ran out of memory. Afterwards both counts are equal.
  void verify(std::span<const Piece> pieces = {});

  /// Groups started and finished since the counts were last equal, modulo 2^32.
  struct Groups {
    std::uint32_t started = 0, finished = 0;
  };
  /// Makes the counts equal without a check, as after a dispatch that GL refused, which may or may not have run.
  Groups resync() { return resync({}); }

 private:
  Groups resync(std::span<const Piece> pieces);
  std::uint32_t name_ = 0;      // GL buffer: the counter, then the indirect group counts
  std::uint32_t expected_ = 0;  // groups of all direct dispatches so far, modulo 2^32 like the counter
  std::uint32_t proven_ = 0;    // the counter's value at the last verification
  std::uint32_t indirect_ = 0;  // number of group counts waiting in the buffer
};

}  // namespace meniscus
