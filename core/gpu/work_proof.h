// SPDX-License-Identifier: BSD-3-Clause
// Proof that the GPU did its work: the groups that were started against those that reached the end of their kernel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace meniscus {

/// Bytes of a word, in which kernels count.
inline constexpr std::size_t kWord = sizeof(std::uint32_t);

/// The account of one GL context. A driver may drop a dispatch, or a part of it, without an error; buffers then hold
/// what they held before, and sums of zeros agree with each other. So each kernel counts its groups at its end
/// (gpu_shaders/shared/finished_groups.glsl), Program adds up what it starts, and whatever leaves the GPU is looked at
/// only after both are equal.
class WorkProof {
 public:
  /// For the context current on this thread, whose atomic counter binding 0 it takes. Its memory ends with the context.
  /// Throws CapacityError.
  WorkProof();
  ~WorkProof();
  WorkProof(const WorkProof&) = delete;
  WorkProof& operator=(const WorkProof&) = delete;

  /// That of the EglContext current on this thread. Throws GpuError if there is none.
  static WorkProof& current();
  /// To be called when its context has been made current on this thread.
  void make_current();

  void started(std::uint32_t groups) { expected_ += groups; }
  /// The same for a group count {x, y, z}, three uint32 that kernels wrote to this GL buffer; it is read when it is
  /// needed, and may be overwritten before.
  void started_indirect(std::uint32_t buffer, std::size_t byte_offset);

  /// Words of a buffer that come to the host in the same read as the account.
  struct Piece {
    std::uint32_t buffer = 0;  ///< GL name
    std::size_t byte_offset = 0;
    std::span<std::uint32_t> words;
  };
  static constexpr std::size_t kMostPieceWords = 128;  ///< of all pieces together

  /// Waits for the GPU, and fills in the pieces. Throws GpuError if a group that was started has not come to its end,
  /// or if the driver has reset the context; CapacityError if it ran out of memory. Afterwards the account is even.
  void verify(std::span<const Piece> pieces = {});

  /// Groups started and finished since the account was even, modulo 2^32.
  struct Groups {
    std::uint32_t started = 0, finished = 0;
  };
  /// Evens the account without a judgement, as after a dispatch that GL refused: it may have run or not.
  Groups settle() { return settle({}); }

 private:
  Groups settle(std::span<const Piece> pieces);
  std::uint32_t name_ = 0;      // of the GL buffer: the counter, then the indirect group counts
  std::uint32_t expected_ = 0;  // groups of direct dispatches ever, modulo 2^32 as the counter
  std::uint32_t proven_ = 0;    // the counter's value when it was last verified
  std::uint32_t indirect_ = 0;  // group counts waiting in the buffer
};

}  // namespace meniscus
