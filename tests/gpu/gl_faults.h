// SPDX-License-Identifier: BSD-3-Clause
// Makes GL fail on purpose, in this process, through epoxy's function pointers.
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
    idle,           ///< dispatches: none does anything, and the GPU says that all came to their end; the account of
                    ///< work has to be settled behind it
    no_reads,       ///< of buffers: the host keeps what it had
    poison          ///< every fresh buffer is full of the word `at`
  };
  Kind kind = Kind::none;
  std::uint32_t at = 0;
};

/// Calls of one kind each.
struct GlCalls {
  std::uint32_t dispatches = 0;
  std::uint32_t error_questions = 0;   ///< glGetError
  std::uint32_t finishes = 0;          ///< glFinish
  std::uint32_t reads = 0;             ///< of buffers and textures, to the host
  std::uint32_t waiting_reads = 0;     ///< those with a dispatch between them and the read before
  std::uint32_t uploads = 0;           ///< to buffers that are there
  std::uint32_t buffers_changed = 0;   ///< made, or deleted
  std::uint32_t textures_changed = 0;  ///< made, or deleted, or given another buffer
  std::uint32_t shaders_compiled = 0;
  std::uint32_t uniforms_looked_up = 0;  ///< glGetUniformLocation
};

/// From now on this fault, and all counts from 0. The first call takes epoxy's pointers.
void plan(GlFault fault);

/// Since the last plan().
const GlCalls& calls_seen();

}  // namespace meniscus::testing
