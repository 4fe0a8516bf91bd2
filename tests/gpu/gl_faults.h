// SPDX-License-Identifier: BSD-3-Clause
// Makes GL fail on purpose, in this process, through epoxy's function pointers.
#pragma once

#include <cstdint>

namespace meniscus::testing {

/// A fault and the call at which it happens or begins; calls of one kind count together from 0.
struct GlFault {
  enum class Kind {
    none,
    drop_from,      ///< dispatches: this one and all later ones do nothing, without an error
    drop_one,       ///< dispatches: this one only
    out_of_memory,  ///< questions for errors: this one is answered by GL_OUT_OF_MEMORY
    reset,          ///< questions for errors: this one loses the context, and nothing happens any more
    idle,           ///< dispatches: none does anything, and the GPU says that all came to their end; the account of
                    ///< work has to be settled behind it
    no_reads,       ///< reads of buffers: the host keeps its old data
    poison          ///< every fresh buffer is full of the word `at`
  };
  Kind kind = Kind::none;
  std::uint32_t at = 0;
};

/// Numbers of calls of each kind.
struct GlCalls {
  std::uint32_t dispatches = 0;
  std::uint32_t error_questions = 0;   ///< glGetError
  std::uint32_t finishes = 0;          ///< glFinish
  std::uint32_t reads = 0;             ///< reads of buffers and textures to the host
  std::uint32_t waiting_reads = 0;     ///< reads with a dispatch since the read before
  std::uint32_t uploads = 0;           ///< uploads to existing buffers
  std::uint32_t buffers_changed = 0;   ///< buffers made or deleted
  std::uint32_t textures_changed = 0;  ///< textures made, deleted, or given another buffer
  std::uint32_t shaders_compiled = 0;
  std::uint32_t uniforms_looked_up = 0;  ///< glGetUniformLocation
};

/// Plans this fault and sets all counts to 0. The first call takes epoxy's pointers.
void plan(GlFault fault);

/// Returns the calls since the last plan().
const GlCalls& calls_seen();

}  // namespace meniscus::testing
