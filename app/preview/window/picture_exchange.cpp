// SPDX-License-Identifier: BSD-3-Clause
// Triple buffering: neither side waits for the other's frame.
#include "app/preview/window/picture_exchange.h"

#include <utility>

#include <epoxy/gl.h>

namespace meniscus {

PictureExchange::~PictureExchange() {
  for (const SharedPicture& slot : slots_) glDeleteTextures(1, &slot.texture);
}

/// With a texture of this size. Nobody else touches it.
SharedPicture& PictureExchange::free_slot(glm::ivec2 size) {
  SharedPicture& slot = slots_[free_];
  if (slot.size != size) {
    glDeleteTextures(1, &slot.texture);
    glCreateTextures(GL_TEXTURE_2D, 1, &slot.texture);
    glTextureStorage2D(slot.texture, 1, GL_RGBA8, size.x, size.y);
    slot.size = size;
  }
  return slot;
}

void PictureExchange::offer(std::uint32_t texture, glm::ivec2 size) {
  const SharedPicture& slot = free_slot(size);
  glCopyImageSubData(texture, GL_TEXTURE_2D, 0, 0, 0, 0, slot.texture, GL_TEXTURE_2D, 0, 0, 0, 0, size.x, size.y, 1);
  offer_free_slot();
}

void PictureExchange::offer(std::span<const std::uint8_t> rgba, glm::ivec2 size) {
  glTextureSubImage2D(free_slot(size).texture, 0, 0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  offer_free_slot();
}

void PictureExchange::offer_free_slot() {
  glFinish();  // other contexts see what is finished
  const std::scoped_lock lock(mutex_);
  std::swap(free_, ready_);
  fresh_ = true;
}

SharedPicture PictureExchange::newest() {
  const std::scoped_lock lock(mutex_);
  if (fresh_) {
    glFinish();  // what is shown until now may be written from here on
    std::swap(shown_, ready_);
    fresh_ = false;
  }
  return slots_[shown_];
}

}  // namespace meniscus
