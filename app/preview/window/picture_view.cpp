// SPDX-License-Identifier: BSD-3-Clause
// A blit: bytes are copied as they are, because neither side is declared to be sRGB.
#include "app/preview/window/picture_view.h"

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
