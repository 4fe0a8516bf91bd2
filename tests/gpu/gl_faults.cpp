// SPDX-License-Identifier: BSD-3-Clause
// Wrappers around the GL calls that matter, put into epoxy's pointers.
#include "tests/gpu/gl_faults.h"

#include <type_traits>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace meniscus::testing {
namespace {

using Kind = GlFault::Kind;

GlFault planned;
std::uint32_t dispatches = 0, questions = 0, waits = 0;

bool lost() { return planned.kind == Kind::reset && questions > planned.at; }

bool drops_this_dispatch() {
  const std::uint32_t n = dispatches++;
  return lost() || (planned.kind == Kind::drop_from && n >= planned.at) ||
         (planned.kind == Kind::drop_one && n == planned.at);
}

/// The driver's own function behind one of epoxy's pointers.
template <auto& pointer>
auto driver(const char* name) {
  static const auto function = reinterpret_cast<std::remove_reference_t<decltype(pointer)>>(eglGetProcAddress(name));
  return function;
}

void dispatch(GLuint x, GLuint y, GLuint z) {
  if (!drops_this_dispatch()) driver<epoxy_glDispatchCompute>("glDispatchCompute")(x, y, z);
}

void dispatch_indirect(GLintptr offset) {
  if (!drops_this_dispatch()) driver<epoxy_glDispatchComputeIndirect>("glDispatchComputeIndirect")(offset);
}

GLenum get_error() {
  const std::uint32_t n = questions++;
  if (lost()) return GL_CONTEXT_LOST;
  const GLenum error = driver<epoxy_glGetError>("glGetError")();
  return planned.kind == Kind::out_of_memory && n == planned.at ? GL_OUT_OF_MEMORY : error;
}

void finish() {
  ++waits;
  driver<epoxy_glFinish>("glFinish")();
}

GLenum reset_status() { return lost() ? GL_UNKNOWN_CONTEXT_RESET : GL_NO_ERROR; }

void read_buffer(GLuint buffer, GLintptr offset, GLsizeiptr size, void* data) {
  if (lost() || planned.kind == Kind::no_reads) return;
  driver<epoxy_glGetNamedBufferSubData>("glGetNamedBufferSubData")(buffer, offset, size, data);
}

void make_storage(GLuint buffer, GLsizeiptr size, const void* data, GLbitfield flags) {
  std::vector<std::uint32_t> poison;
  if (!data && planned.kind == Kind::poison) poison.assign((static_cast<std::size_t>(size) + 3) / 4, planned.at);
  driver<epoxy_glNamedBufferStorage>("glNamedBufferStorage")(buffer, size, poison.empty() ? data : poison.data(),
                                                             flags);
}

}  // namespace

void plan(GlFault fault) {
  planned = fault;
  dispatches = questions = waits = 0;
  epoxy_glDispatchCompute = dispatch;
  epoxy_glDispatchComputeIndirect = dispatch_indirect;
  epoxy_glFinish = finish;
  epoxy_glGetError = get_error;
  epoxy_glGetGraphicsResetStatus = reset_status;
  epoxy_glGetNamedBufferSubData = read_buffer;
  epoxy_glNamedBufferStorage = make_storage;
}

std::uint32_t dispatches_seen() { return dispatches; }
std::uint32_t error_questions_seen() { return questions; }
std::uint32_t waits_seen() { return waits; }

}  // namespace meniscus::testing
