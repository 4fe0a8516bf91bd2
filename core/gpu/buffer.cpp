// SPDX-License-Identifier: BSD-3-Clause
// Creates, fills, copies and reads buffers of GPU memory.
#include "core/gpu/buffer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cstring>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/gpu/context_description.h"

namespace meniscus {
namespace {

/// Rounds up to whole 16-byte rows, for fill() and vec4 arrays. Empty buffers get memory, too, to be bound.
std::size_t in_rows(std::size_t byte_count) { return byte_count < 16 ? 16 : (byte_count + 15) / 16 * 16; }

std::atomic<std::uint64_t> allocations = 0;

}  // namespace

Buffer::~Buffer() {
  if (name_) glDeleteBuffers(1, &name_);
}

Buffer::Buffer(Buffer&& other) noexcept { *this = std::move(other); }

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(name_, other.name_);
  std::swap(memory_, other.memory_);
  std::swap(byte_count_, other.byte_count_);
  std::swap(capacity_, other.capacity_);
  return *this;
}

void Buffer::resize(std::size_t byte_count) {
  if (in_rows(byte_count) > capacity_) {
    const std::size_t room = capacity_ > 0 ? byte_count / 8 : 0;
    const std::size_t needed = in_rows(byte_count + room);
    if (name_) glDeleteBuffers(1, &name_);
    name_ = 0;
    capacity_ = byte_count_ = memory_ = 0;
    glCreateBuffers(1, &name_);
    glNamedBufferStorage(name_, static_cast<GLsizeiptr>(needed), nullptr, GL_DYNAMIC_STORAGE_BIT);
    check_gl("allocating a buffer");
    capacity_ = needed;
    memory_ = ++allocations;
  }
  byte_count_ = byte_count;
}

void Buffer::grow(std::size_t byte_count) {
  if (in_rows(byte_count) <= capacity_) return resize(byte_count);
  Buffer old = std::move(*this);
  resize(byte_count + byte_count / 8);
  resize(byte_count);
  if (old.byte_count_ == 0) return;
  glCopyNamedBufferSubData(old.name_, name_, 0, 0, static_cast<GLsizeiptr>(std::min(old.byte_count_, byte_count)));
  check_gl("growing a buffer");
}

void Buffer::write(std::size_t byte_offset, const void* bytes, std::size_t byte_count) {
  assert(byte_offset + byte_count <= byte_count_);
  if (byte_count == 0) return;
  glNamedBufferSubData(name_, static_cast<GLintptr>(byte_offset), static_cast<GLsizeiptr>(byte_count), bytes);
  check_gl("uploading a buffer");
}

void Buffer::read(std::size_t byte_offset, void* bytes, std::size_t byte_count) const {
  assert(byte_offset + byte_count <= byte_count_);
  if (byte_count == 0) return;
  std::array<std::uint32_t, 16> words;  // reads of at most this many words come along with the proof
  if (byte_offset % 4 == 0 && byte_count % 4 == 0 && byte_count <= sizeof words) {
    const WorkProof::Piece piece{name_, byte_offset, std::span(words).first(byte_count / 4)};
    WorkProof::current().verify({&piece, 1});
    std::memcpy(bytes, words.data(), byte_count);
    return;
  }
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(name_, static_cast<GLintptr>(byte_offset), static_cast<GLsizeiptr>(byte_count), bytes);
  check_gl("downloading a buffer");
  WorkProof::current().verify();
}

void Buffer::copy(const Buffer& source, std::size_t byte_offset, std::size_t to, std::size_t byte_count) {
  assert(to + byte_count <= byte_count_);
  glCopyNamedBufferSubData(source.name_, name_, static_cast<GLintptr>(byte_offset), static_cast<GLintptr>(to),
                           static_cast<GLsizeiptr>(byte_count));
  check_gl("copying a part of a buffer");
}

void Buffer::fill(std::uint32_t word) {
  if (!name_) return;
  glClearNamedBufferData(name_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &word);
  check_gl("filling a buffer");
}

void Buffer::bind(std::uint32_t binding) const {
  // The limit is that of kernels; a buffer fetched as texels may be larger.
  GLint64 limit = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  if (byte_count_ > static_cast<std::size_t>(limit))
    throw CapacityError("a GPU buffer of {} MiB is needed; this driver's limit is {} MiB",
                        (byte_count_ + (1 << 20) - 1) >> 20, limit >> 20);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_);
}

TexelBuffer::~TexelBuffer() {
  if (texture_) glDeleteTextures(1, &texture_);
}

void TexelBuffer::upload_bytes(std::span<const std::byte> bytes) {
  buffer_.upload(bytes);
  attach(buffer_);
}

void TexelBuffer::view(const Buffer& storage) {
  attach(storage);
  // Kernels wrote the buffer as storage and now fetch it as texels.
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void TexelBuffer::attach(const Buffer& storage) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
  const std::size_t texels = storage.byte_count() / (format_ == TexelFormat::uint1 ? 4 : 16);
  if (texels > static_cast<std::size_t>(limit))
    throw CapacityError("{} texels are needed; this driver's limit is {}", texels, limit);
  // The view covers all of the buffer's memory, so nothing changes while the memory stays the same.
  if (shown_ == storage.memory()) return;
  if (!texture_) glCreateTextures(GL_TEXTURE_BUFFER, 1, &texture_);
  glTextureBuffer(texture_, format_ == TexelFormat::uint1 ? GL_R32UI : GL_RGBA32UI, storage.gl_name());
  shown_ = 0;
  check_gl("making a buffer texture");
  shown_ = storage.memory();
}

void TexelBuffer::bind(std::uint32_t unit) const { glBindTextureUnit(unit, texture_); }

Counting suitable_counting() { return describe_current_context().software ? Counting::now : Counting::later; }

}  // namespace meniscus
