// SPDX-License-Identifier: BSD-3-Clause
// Words of several buffers that come to the host in one read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/gpu/buffer.h"
#include "core/gpu/work_proof.h"

namespace meniscus {

/// When the host learns what kernels have counted.
enum class Counting {
  now,   ///< behind the kernel that counts, so that everything gets the room that it needs
  later  ///< at the end of a frame, which trusts in the sizes of the last one, and is made again if they were too small
};

/// What suits the device of the current context: a GPU should not wait between stages; software GL runs each kernel at
/// once, waits for nothing, and is better off with exact sizes than with room.
Counting suitable_counting();

/// Counts of a frame, asked for by those who made them and read together. Needs a current EglContext.
class Readback {
 public:
  /// `words` of `buffer` from `byte_offset` on; they must stay until read().
  void ask(const Buffer& buffer, std::size_t byte_offset, std::span<std::uint32_t> words) {
    pieces_.push_back({buffer.gl_name(), byte_offset, words});
  }
  /// Waits for the GPU, proves its work, and fills in what was asked for. Throws as WorkProof::verify().
  void read() const { WorkProof::current().verify(pieces_); }

 private:
  std::vector<WorkProof::Piece> pieces_;
};

}  // namespace meniscus
