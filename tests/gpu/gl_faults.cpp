// SPDX-License-Identifier: BSD-3-Clause
// Wraps the GL calls that can fail, and puts the wrappers into epoxy's pointers.
#include "tests/gpu/gl_faults.h"

#include <type_traits>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace meniscus::testing {
namespace {

using Kind = GlFault::Kind;

GlFault planned;
GlCalls calls;
bool waits = false;        // true if the next read waits for a dispatch
std::uint32_t unmade = 0;  // groups that an idle GPU says it has finished

bool lost() { return planned.kind == Kind::reset && calls.error_questions > planned.at; }

bool drops_this_dispatch() {
  const std::uint32_t n = calls.dispatches++;
  waits = true;
  return lost() || planned.kind == Kind::idle || (planned.kind == Kind::drop_from && n >= planned.at) ||
         (planned.kind == Kind::drop_one && n == planned.at);
}

/// Returns the driver's own function behind one of epoxy's pointers.
template <auto& pointer>
auto driver(const char* name) {
  static const auto function = reinterpret_cast<std::remove_reference_t<decltype(pointer)>>(eglGetProcAddress(name));
  return function;
}

/// Counts a call and passes it on.
template <auto& pointer, std::uint32_t GlCalls::*count, typename Function>
struct Counted;
template <auto& pointer, std::uint32_t GlCalls::*count, typename Result, typename... Arguments>
struct Counted<pointer, count, Result (*)(Arguments...)> {
  static inline const char* name = nullptr;
  static Result call(Arguments... arguments) {
    ++(calls.*count);
    return driver<pointer>(name)(arguments...);
  }
};
template <auto& pointer, std::uint32_t GlCalls::*count>
void take(const char* name) {
  using Taken = Counted<pointer, count, std::remove_reference_t<decltype(pointer)>>;
  Taken::name = name;
  pointer = Taken::call;
}

void dispatch(GLuint x, GLuint y, GLuint z) {
  if (!drops_this_dispatch()) return driver<epoxy_glDispatchCompute>("glDispatchCompute")(x, y, z);
  if (planned.kind == Kind::idle) unmade += x * y * z;
}

void dispatch_indirect(GLintptr offset) {
  if (!drops_this_dispatch()) return driver<epoxy_glDispatchComputeIndirect>("glDispatchComputeIndirect")(offset);
  if (planned.kind != Kind::idle) return;
  GLuint counts[3] = {};
  glGetBufferSubData(GL_DISPATCH_INDIRECT_BUFFER, offset, sizeof counts, counts);
  unmade += counts[0] * counts[1] * counts[2];
}

GLenum get_error() {
  const std::uint32_t n = calls.error_questions++;
  if (lost()) return GL_CONTEXT_LOST;
  const GLenum error = driver<epoxy_glGetError>("glGetError")();
  return planned.kind == Kind::out_of_memory && n == planned.at ? GL_OUT_OF_MEMORY : error;
}

GLenum reset_status() { return lost() ? GL_UNKNOWN_CONTEXT_RESET : GL_NO_ERROR; }

void count_read() {
  ++calls.reads;
  calls.waiting_reads += waits;
  waits = false;
}

void read_buffer(GLuint buffer, GLintptr offset, GLsizeiptr size, void* data) {
  count_read();
  if (lost() || planned.kind == Kind::no_reads) return;
  driver<epoxy_glGetNamedBufferSubData>("glGetNamedBufferSubData")(buffer, offset, size, data);
  GLint account = 0;  // buffer that counts finished groups
  glGetIntegeri_v(GL_ATOMIC_COUNTER_BUFFER_BINDING, 0, &account);
  if (buffer == static_cast<GLuint>(account) && offset == 0) *static_cast<GLuint*>(data) += unmade;
}

void read_texture(GLuint texture, GLint level, GLenum format, GLenum type, GLsizei size, void* pixels) {
  count_read();
  driver<epoxy_glGetTextureImage>("glGetTextureImage")(texture, level, format, type, size, pixels);
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
  calls = {};
  waits = false;
  unmade = 0;
  epoxy_glDispatchCompute = dispatch;
  epoxy_glDispatchComputeIndirect = dispatch_indirect;
  epoxy_glGetError = get_error;
  epoxy_glGetGraphicsResetStatus = reset_status;
  epoxy_glGetNamedBufferSubData = read_buffer;
  epoxy_glGetTextureImage = read_texture;
  epoxy_glNamedBufferStorage = make_storage;
  take<epoxy_glFinish, &GlCalls::finishes>("glFinish");
  take<epoxy_glNamedBufferSubData, &GlCalls::uploads>("glNamedBufferSubData");
  take<epoxy_glCreateBuffers, &GlCalls::buffers_changed>("glCreateBuffers");
  take<epoxy_glDeleteBuffers, &GlCalls::buffers_changed>("glDeleteBuffers");
  take<epoxy_glCreateTextures, &GlCalls::textures_changed>("glCreateTextures");
  take<epoxy_glDeleteTextures, &GlCalls::textures_changed>("glDeleteTextures");
  take<epoxy_glTextureBuffer, &GlCalls::textures_changed>("glTextureBuffer");
  take<epoxy_glCompileShader, &GlCalls::shaders_compiled>("glCompileShader");
  take<epoxy_glGetUniformLocation, &GlCalls::uniforms_looked_up>("glGetUniformLocation");
}

const GlCalls& calls_seen() { return calls; }

}  // namespace meniscus::testing
