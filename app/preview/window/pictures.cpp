// SPDX-License-Identifier: BSD-3-Clause
// Buffers pictures three times, so that neither side waits for the other's frame, then copies bytes as they are by a
// blit.
#include "app/preview/window/pictures.h"

#include <utility>

#include <epoxy/gl.h>
#include <glm/common.hpp>

namespace meniscus {
namespace {

/// Upper left corner of the largest rectangle in `area` with the sides' ratio of `size`; halves that were rounded do
/// not count.
glm::ivec2 fitting_corner(glm::ivec2 size, glm::ivec2 area) {
  const glm::dvec2 stretch = glm::dvec2(area) / glm::dvec2(size);
  const glm::dvec2 gap = glm::dvec2(area) - glm::dvec2(size) * glm::min(stretch.x, stretch.y);
  return {gap.x > 2.0 ? static_cast<int>(gap.x / 2.0) : 0, gap.y > 2.0 ? static_cast<int>(gap.y / 2.0) : 0};
}

}  // namespace

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

PictureView::PictureView() { glCreateFramebuffers(1, &framebuffer_); }
PictureView::~PictureView() { glDeleteFramebuffers(1, &framebuffer_); }

void PictureView::show(std::uint32_t texture, glm::ivec2 size, glm::ivec2 area, glm::ivec2 window) {
  const glm::ivec2 corner = fitting_corner(size, area), end = area - corner;
  glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture, 0);
  // Windows count rows from below, pictures from above.
  glBlitNamedFramebuffer(framebuffer_, 0, 0, 0, size.x, size.y, corner.x, window.y - corner.y, end.x, window.y - end.y,
                         GL_COLOR_BUFFER_BIT, size == area ? GL_NEAREST : GL_LINEAR);
}

}  // namespace meniscus
