// SPDX-License-Identifier: BSD-3-Clause
// Runs depth, occlusion and finish kernels, one after the other.
#include "core/render/look_pass.h"

namespace meniscus {

void LookPass::add(const CastSample& sample, const Look& look, const GpuScene& scene, const PictureFrame& frame,
                   const PictureBlock& block, const Buffer& picture) {
  const std::size_t count = static_cast<std::size_t>(block.size.x) * block.size.y;
  depths_.resize(count * sizeof(float));
  visibility_.resize(count * sizeof(float));
  const bool has_parts = scene.parts.byte_count() > 0;
  parts_.resize(has_parts ? count * sizeof(std::uint32_t) : 0);
  const auto run = [&](const Program& program) {
    set_block(program, frame, block);
    program.set("sample_offset", sample.offset);
    program.set("sample_index", sample.index);
    program.dispatch_2d((static_cast<std::uint32_t>(block.size.x) + 7) / 8,
                        (static_cast<std::uint32_t>(block.size.y) + 7) / 8);
  };
  hit_texels_.view(sample.hits);
  hit_texels_.bind(0);
  atom_part_texels_.view(scene.parts);
  atom_part_texels_.bind(2);
  depths_.bind(0);
  parts_.bind(1);
  const Program& depth = programs_.get("gpu_shaders/look/depth.comp");
  depth.set("has_parts", has_parts ? 1u : 0u);
  run(depth);
  depth_texels_.view(depths_);
  depth_texels_.bind(1);
  if (look.ambient_occlusion > 0.0f) {
    const Program& program = programs_.get("gpu_shaders/look/occlusion.comp");
    program.set("radius", look.ambient_occlusion_radius);
    program.set("longest_reach", static_cast<float>(kLongestShade));
    visibility_.bind(0);
    run(program);
  }
  ShaderDefines effects;
  if (look.ambient_occlusion > 0.0f) effects.emplace_back("AMBIENT_OCCLUSION", "1");
  if (look.silhouettes > 0.0f) effects.emplace_back("SILHOUETTES", "1");
  const Program& program = programs_.get("gpu_shaders/look/finish.comp", effects);
  visibility_texels_.view(visibility_);
  visibility_texels_.bind(2);
  part_texels_.view(parts_);
  part_texels_.bind(3);
  sample.colors.bind(0);
  picture.bind(1);
  program.set("ambient_occlusion", look.ambient_occlusion);
  program.set("silhouettes", look.silhouettes);
  program.set("depth_cue", look.depth_cue);
  program.set("first_depth", scene.first_depth);
  program.set("last_depth", scene.last_depth);
  program.set("has_parts", has_parts ? 1u : 0u);
  run(program);
}

}  // namespace meniscus
