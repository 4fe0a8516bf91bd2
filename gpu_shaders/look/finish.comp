// SPDX-License-Identifier: BSD-3-Clause
// Applies shade, depth cueing and silhouettes to one sample of each pixel of a block, and adds it to the picture.
// AMBIENT_OCCLUSION and SILHOUETTES are defined where they are asked for: software GL would pay for them all the same.
#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
#include "gpu_shaders/look/block_texels.glsl"
#include "gpu_shaders/look/parameters.glsl"

layout(binding = 2) uniform usamplerBuffer visibility_texels;  // there for AMBIENT_OCCLUSION
layout(binding = 3) uniform usamplerBuffer mark_texels;  // of each pixel; there if has_marks
layout(std430, binding = 0) readonly buffer Samples { vec4 samples[]; };  // linear, premultiplied
layout(std430, binding = 1) buffer Picture { vec4 picture[]; };

layout(std140, binding = 0) uniform Parameters { FinishParameters params; };

float visibility_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(visibility_texels, index_of(pixel)).x); }

#include "gpu_shaders/ray_cast/sheen.glsl"
#include "gpu_shaders/look/finish.glsl"

int mark_at(ivec2 pixel) { return int(texelFetch(mark_texels, index_of(pixel)).x); }

// Shares of a pixel that black lines cover, with the depth of what they outline, and that lines around patches cover.
struct Ink {
  float covered;
  float depth;
  float patched;
};

// Software GL runs every branch: so each pixel first looks, cheaply, for the next neighbour that matters to it.
Ink ink_on(ivec2 pixel, float depth) {
  int reach = farthest_neighbor();
  Ink ink = Ink(0.0, depth, 0.0);
  ivec2 offset = ivec2(-reach - 1, -reach);
  do {
    ivec2 other;
    float share;
    float other_depth;
    bool step;
    bool seam;
    bool border;
    do {
      ++offset.x;
      if (offset.x > reach) offset = ivec2(-reach, offset.y + 1);
      other = pixel + offset;
      other_depth = depth_at(other);
      share = covered_share(offset, params.widest_line);
      bool inside = offset.y <= reach && in_block(other);
      bool counts = inside && share > ink.covered;
      step = counts && may_step(depth, other_depth);
      seam = border = false;
      if (params.has_marks != 0u && inside && depth != kNothing && other_depth != kNothing) {
        int mark = mark_at(pixel);
        int other_mark = mark_at(other);
        seam = counts && parts_differ(mark, other_mark);
        border = covered_share(offset, params.patch_lines) > ink.patched &&
                 parted_by_patch(pixel, depth, mark, other, other_depth, other_mark);
      }
    } while (!step && !seam && !border && offset.y <= reach);
    float strength = step ? step_ink(pixel, depth, other, other_depth) : 0.0;
    float covered = covered_by_border(offset, strength, seam, depth == kNothing || other_depth == kNothing);
    if (border) ink.patched = covered_share(offset, params.patch_lines);
    if ((step || seam) && covered > ink.covered) ink = Ink(covered, min(depth, other_depth), ink.patched);
  } while (offset.y <= reach);
  return ink;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (!in_block(pixel)) return;
  int at = index_of(pixel);
  vec4 color = samples[at];
  float depth = depth_at(pixel);
#ifdef AMBIENT_OCCLUSION
  if (depth != kNothing) color.rgb = shaded(color.rgb, color.a, pixel, depth);
#endif
  if (depth != kNothing) {
    float clear = clarity(depth);
    color = params.keeps_alpha != 0u ? vec4(mix(params.air * color.a, color.rgb, clear), color.a) : color * clear;
  }
#ifdef SILHOUETTES
  Ink ink = ink_on(pixel, depth);
  if (ink.patched > 0.0) {
    float patched = ink.patched * clarity(depth);
    color = mix(color, vec4(params.patch_line_color, 1.0), patched);
  }
  float covered = ink.covered * clarity(ink.depth);
  color = vec4(color.rgb * (1.0 - covered), mix(color.a, 1.0, covered));
#endif
  picture[at] = params.sample_index == 0u ? color : picture[at] + color;
}
