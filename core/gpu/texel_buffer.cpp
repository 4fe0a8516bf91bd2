// SPDX-License-Identifier: BSD-3-Clause
// Buffer textures (GL 3.1) over storage buffers.
#include "core/gpu/texel_buffer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/gpu/limits.h"

namespace meniscus {

TexelBuffer::~TexelBuffer() {
  if (texture_) glDeleteTextures(1, &texture_);
}

void TexelBuffer::upload_bytes(std::span<const std::byte> bytes) {
  buffer_.upload(bytes);
  attach(buffer_);
}

void TexelBuffer::view(const Buffer& storage) {
  attach(storage);
  // Kernels wrote it as storage and now fetch it as texels.
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void TexelBuffer::attach(const Buffer& storage) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
  const std::size_t texels = storage.byte_count() / (format_ == TexelFormat::uint1 ? 4 : 16);
  if (texels > static_cast<std::size_t>(limit))
    throw CapacityError(fmt::format("{} texels are needed; this driver's limit is {}", texels, limit));
  // It shows all of the buffer's memory, so nothing changes as long as that stays.
  if (shown_ == storage.memory()) return;
  if (!texture_) glCreateTextures(GL_TEXTURE_BUFFER, 1, &texture_);
  glTextureBuffer(texture_, format_ == TexelFormat::uint1 ? GL_R32UI : GL_RGBA32UI, storage.gl_name());
  shown_ = 0;
  check_gl("making a buffer texture");
  shown_ = storage.memory();
}

void TexelBuffer::bind(std::uint32_t unit) const { glBindTextureUnit(unit, texture_); }

}  // namespace meniscus
