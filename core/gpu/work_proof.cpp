// SPDX-License-Identifier: BSD-3-Clause
// An atomic counter, copies of indirect group counts, and their comparison with what the host started.
#include "core/gpu/work_proof.h"

#include <array>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/gpu/context_description.h"
#include "core/gpu/limits.h"

namespace meniscus {
namespace {

constexpr std::size_t kWord = sizeof(std::uint32_t);
constexpr std::uint32_t kMostIndirect = 64;  // dispatches between two proofs; a frame of one sample makes two

/// The GL buffer as the host reads it.
struct Account {
  std::uint32_t finished = 0;
  std::array<std::uint32_t, 3 * kMostIndirect> indirect{};
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

void WorkProof::verify() {
  if (expected_ != proven_ || indirect_ > 0) {
    const Groups groups = settle();
    if (groups.started != groups.finished) {
      require_living_context();
      throw GpuError(
          fmt::format("the GPU left work undone without saying so: of {} groups of its kernels {} came to their end; "
                      "nothing that it "
                      "computed is used; run again, or on another --device",
                      groups.started, groups.finished));
    }
  }
  require_living_context();
}

WorkProof::Groups WorkProof::settle() {
  Account account{proven_, {}};
  account.indirect.fill(~0u);  // with the line above: a read that does nothing proves nothing
  glMemoryBarrier(GL_ATOMIC_COUNTER_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(kWord * (1 + 3 * indirect_)), &account);
  check_gl("counting finished groups");
  for (std::size_t n = 0; n < 3 * std::size_t{indirect_}; n += 3)
    expected_ += account.indirect[n] * account.indirect[n + 1] * account.indirect[n + 2];
  const Groups groups{expected_ - proven_, account.finished - proven_};
  expected_ = proven_ = account.finished;
  indirect_ = 0;
  return groups;
}

}  // namespace meniscus
