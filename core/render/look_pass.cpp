// SPDX-License-Identifier: BSD-3-Clause
// Runs the kernels for occlusion, depth cueing and silhouettes, and the one that turns a picture into a texture.
#include "core/render/look_pass.h"

#include <epoxy/gl.h>

#include "core/gpu/context_description.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/work_proof.h"
#include "core/image/color_space.h"

namespace meniscus {

void LookPass::add(const CastSample& sample, const Look& look, const GpuScene& scene, const PictureFrame& frame,
                   const PictureBlock& block, const Buffer& picture) {
  const std::size_t count = static_cast<std::size_t>(block.size.x) * block.size.y;
  const bool is_map = look.ambient_occlusion > 0.0f && sample.index == 0 && holds_shade_map(block, frame.size);
  Buffer& depths = is_map ? shade_map_ : depths_;
  TexelBuffer& depth_texels = is_map ? map_texels_ : depth_texels_;
  depths.resize(count * sizeof(float));
  shade_.resize(count * sizeof(glm::vec2));
  const bool has_marks = scene.marks.byte_count() > 0;
  marks_.resize(has_marks ? count * sizeof(std::uint32_t) : 0);
  const kernel::BlockView view = block_view(frame, block, sample.offset);
  const auto run = [&](const Program& program, const auto& parameters) {
    program.set(parameters);
    program.set(view, kernel::kBlockViewBinding);
    program.dispatch_2d((static_cast<std::uint32_t>(block.size.x) + 7) / 8,
                        (static_cast<std::uint32_t>(block.size.y) + 7) / 8);
  };
  TexelBuffer& hit_texels = sample.index == 0 ? first_hit_texels_ : hit_texels_;
  hit_texels.view(sample.hits);
  hit_texels.bind(0);
  atom_mark_texels_.view(scene.marks);
  atom_mark_texels_.bind(2);
  depths.bind(0);
  marks_.bind(1);
  run(programs_.get("gpu_shaders/look/depth.comp"), kernel::DepthParameters{.has_marks = has_marks});
  depth_texels.view(depths);
  depth_texels.bind(1);
  if (look.ambient_occlusion > 0.0f && sample.index == shade_sample(sample.index)) {
    map_texels_.bind(2);
    shade_.bind(0);
    run(programs_.get("gpu_shaders/look/occlusion.comp"), occlusion_parameters(look, frame.size, sample.index));
  }
  ShaderDefines effects;
  if (look.ambient_occlusion > 0.0f) effects.emplace_back("AMBIENT_OCCLUSION", "1");
  if (look.widest_line() > 0.0f) effects.emplace_back("SILHOUETTES", "1");
  shade_texels_.view(shade_);
  shade_texels_.bind(2);
  mark_texels_.view(marks_);
  mark_texels_.bind(3);
  sample.colors.bind(0);
  picture.bind(1);
  run(programs_.get("gpu_shaders/look/finish.comp", effects),
      finish_parameters(look, scene, frame.size, sample.index, has_marks));
}

std::vector<float> LookPass::depths(const Buffer& hits, const PictureFrame& frame, const PictureBlock& block) {
  const std::size_t count = static_cast<std::size_t>(block.size.x) * block.size.y;
  depths_.resize(count * sizeof(float));
  first_hit_texels_.view(hits);
  first_hit_texels_.bind(0);
  depths_.bind(0);
  const Program& program = programs_.get("gpu_shaders/look/depth.comp");
  program.set(kernel::DepthParameters{.has_marks = false});
  program.set(block_view(frame, block, glm::vec2(0.0f)), kernel::kBlockViewBinding);
  program.dispatch_2d((static_cast<std::uint32_t>(block.size.x) + 7) / 8,
                      (static_cast<std::uint32_t>(block.size.y) + 7) / 8);
  return depths_.download<float>(count);
}

void LookPass::set_shade_map(const std::vector<float>& depths) {
  shade_map_.upload(depths);
  map_texels_.view(shade_map_);
}

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
