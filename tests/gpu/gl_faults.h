// SPDX-License-Identifier: BSD-3-Clause
// GL that goes wrong on purpose, in this process, by way of epoxy's function pointers.
#pragma once

#include <cstdint>

namespace meniscus::testing {

/// What goes wrong, at which call or from which on; calls count from 0, those of one kind together.
struct GlFault {
  enum class Kind {
    none,
    drop_from,      ///< dispatches: this one and all behind it do nothing, without an error
    drop_one,       ///< dispatches: this one only
    out_of_memory,  ///< questions for errors: this one is answered by GL_OUT_OF_MEMORY
    reset,          ///< questions for errors: at this one the context is lost, and nothing happens any more
    no_reads,       ///< of buffers: the host keeps what it had
    poison          ///< every fresh buffer is full of the word `at`
  };
  Kind kind = Kind::none;
  std::uint32_t at = 0;
};

/// From now on this fault, and both counts from 0. The first call takes epoxy's pointers.
void plan(GlFault fault);

/// Calls since the last plan().
std::uint32_t dispatches_seen();
std::uint32_t error_questions_seen();
/// Of glFinish.
std::uint32_t waits_seen();

}  // namespace meniscus::testing
