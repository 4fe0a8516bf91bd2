// SPDX-License-Identifier: BSD-3-Clause
// Counts finished groups with an atomic counter, and compares them with the groups that the host started.
#include "core/gpu/work_proof.h"

#include <algorithm>
#include <array>
#include <cassert>

#include <epoxy/gl.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/gpu/context_description.h"

namespace meniscus {
namespace {

constexpr std::uint32_t kMostIndirect = 64;  // limit of dispatches between two proofs; a frame of one sample makes two

/// The contents of the GL buffer, as the host reads them.
struct Account {
  std::uint32_t finished = 0;
  std::array<std::uint32_t, 3 * kMostIndirect + WorkProof::kMostPieceWords> indirect_and_pieces{};
};

thread_local WorkProof* current_proof = nullptr;

}  // namespace

WorkProof::WorkProof() {
  const Account nothing;
  glCreateBuffers(1, &name_);
  glNamedBufferStorage(name_, sizeof nothing, &nothing, 0);
  glBindBufferBase(GL_ATOMIC_COUNTER_BUFFER, 0, name_);
  check_gl("allocating the count of finished groups");
  make_current();
}

WorkProof::~WorkProof() {
  if (current_proof == this) current_proof = nullptr;
}

WorkProof& WorkProof::current() {
  if (!current_proof) throw GpuError("kernels run in an EglContext only, and none is current on this thread");
  return *current_proof;
}

void WorkProof::make_current() { current_proof = this; }

void WorkProof::started_indirect(std::uint32_t buffer, std::size_t byte_offset) {
  if (indirect_ == kMostIndirect) verify();
  const std::size_t place = kWord * (1 + 3 * indirect_++);
  glCopyNamedBufferSubData(buffer, name_, static_cast<GLintptr>(byte_offset), static_cast<GLintptr>(place), 3 * kWord);
}

void WorkProof::verify(std::span<const Piece> pieces) {
  if (expected_ != proven_ || indirect_ > 0 || !pieces.empty()) {
    const Groups groups = resync(pieces);
    if (groups.started != groups.finished) {
      require_living_context();
      throw GpuError(
          message("the GPU dropped work without reporting an error: of {} kernel groups {} finished; its results are "
                  "discarded; run again, or choose another @device@",
                  groups.started, groups.finished));
    }
  }
  require_living_context();
}

WorkProof::Groups WorkProof::resync(std::span<const Piece> pieces) {
  Account account{proven_, {}};
  auto& words = account.indirect_and_pieces;
  words.fill(~0u);  // together with the line above: a read that has no effect proves nothing
  glMemoryBarrier(GL_ATOMIC_COUNTER_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  const std::size_t first_piece = 3 * std::size_t{indirect_};
  std::size_t end = first_piece;
  for (const Piece& piece : pieces) {
    assert(end + piece.words.size() <= first_piece + kMostPieceWords);
    glCopyNamedBufferSubData(piece.buffer, name_, static_cast<GLintptr>(piece.byte_offset),
                             static_cast<GLintptr>(kWord * (1 + end)),
                             static_cast<GLsizeiptr>(piece.words.size_bytes()));
    end += piece.words.size();
  }
  glGetNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(kWord * (1 + end)), &account);
  check_gl("counting finished groups");
  for (std::size_t n = 0; n < first_piece; n += 3) expected_ += words[n] * words[n + 1] * words[n + 2];
  auto next = words.begin() + static_cast<std::ptrdiff_t>(first_piece);
  for (const Piece& piece : pieces) {
    std::copy_n(next, piece.words.size(), piece.words.begin());
    next += static_cast<std::ptrdiff_t>(piece.words.size());
  }
  const Groups groups{expected_ - proven_, account.finished - proven_};
  expected_ = proven_ = account.finished;
  indirect_ = 0;
  return groups;
}

}  // namespace meniscus
