// SPDX-License-Identifier: BSD-3-Clause
// Keeps a texture of the right size and fills it.
#include "core/render/presenter.h"

#include <epoxy/gl.h>

#include "core/gpu/kernel_parameters.h"
#include "core/gpu/limits.h"
#include "core/gpu/work_proof.h"
#include "core/image/color_space.h"

namespace meniscus {

Presenter::~Presenter() {
  if (texture_) glDeleteTextures(1, &texture_);
}

void Presenter::present(const Buffer& picture, glm::ivec2 size, int sample_count, const glm::vec3& background) {
  if (size != size_) {
    if (texture_) glDeleteTextures(1, &texture_);
    texture_ = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
    glTextureStorage2D(texture_, 1, GL_RGBA8, size.x, size.y);
    check_gl("making the picture's texture");
    size_ = size;
  }
  picture.bind(0);
  glBindImageTexture(0, texture_, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA8);
  program_.set(kernel::PresentParameters{
      .background = linear_from_srgb(background), .per_sample = 1.0f / static_cast<float>(sample_count), .size = size});
  program_.dispatch_2d((static_cast<std::uint32_t>(size.x) + 7) / 8, (static_cast<std::uint32_t>(size.y) + 7) / 8);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

std::vector<std::uint8_t> Presenter::rgba() const {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size_.x) * size_.y * 4);
  if (texture_)
    glGetTextureImage(texture_, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(bytes.size()), bytes.data());
  check_gl("downloading the picture");
  WorkProof::current().verify();
  return bytes;
}

}  // namespace meniscus
