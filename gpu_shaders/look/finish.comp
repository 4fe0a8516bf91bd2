// SPDX-License-Identifier: BSD-3-Clause
// Shade, air and ink on one sample of each pixel of a block, which is then added to the picture.
// AMBIENT_OCCLUSION and SILHOUETTES are defined where they are asked for: software GL would pay for them all the same.
#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
#include "gpu_shaders/look/view_space.glsl"
#include "gpu_shaders/look/parameters.glsl"

layout(binding = 2) uniform usamplerBuffer visibility_texels;  // there for AMBIENT_OCCLUSION
layout(binding = 3) uniform usamplerBuffer part_texels;  // of each pixel; there if has_parts
layout(std430, binding = 0) readonly buffer Samples { vec4 samples[]; };  // linear, premultiplied
layout(std430, binding = 1) buffer Picture { vec4 picture[]; };

layout(std140, binding = 0) uniform Parameters { FinishParameters params; };

// Mean over 4 x 4 pixels, as a square of 5 x 5 whose rim counts half; pixels of other surfaces do not count.
float mean_visibility(ivec2 pixel, float depth) {
  vec3 p = position_at(pixel, depth);
  vec3 normal = normal_at(pixel, to_viewer_at(p));
  float tolerance = 0.3 + 2.0 * pixel_size_at(depth);
  float sum = 0.0;
  float weights = 1e-6;
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) {
      ivec2 other = pixel + ivec2(x, y);
      if (!in_block(other)) continue;
      float other_depth = depth_at(other);
      if (other_depth == kNothing) continue;
      float off_plane = abs(dot(normal, position_at(other, other_depth) - p));
      float weight = (abs(x) == 2 ? 0.5 : 1.0) * (abs(y) == 2 ? 0.5 : 1.0) * max(1.0 - off_plane / tolerance, 0.0);
      sum += weight * uintBitsToFloat(texelFetch(visibility_texels, index_of(other)).x);
      weights += weight;
    }
  return sum / weights;
}

// The least difference of depths that is a step, Å.
float least_step(float depth) { return 0.5 + 2.0 * pixel_size_at(depth); }

// False if no line is drawn between two pixels for their depths.
bool may_step(float depth_a, float depth_b) {
  if (depth_a == kNothing || depth_b == kNothing) return depth_a != depth_b;
  return abs(depth_a - depth_b) > least_step(min(depth_a, depth_b));
}

// How strong that line is: from none at a small step to full at a large one.
float step_ink(ivec2 a, float depth_a, ivec2 b, float depth_b) {
  if (depth_a == kNothing || depth_b == kNothing) return depth_a == depth_b ? 0.0 : 1.0;
  float nearer = min(depth_a, depth_b);
  float least = least_step(nearer);
  // What the slope of the flatter one explains is no step.
  vec3 viewer_a = to_viewer_at(position_at(a, depth_a));
  vec3 viewer_b = to_viewer_at(position_at(b, depth_b));
  float facing = max(dot(normal_at(a, viewer_a), viewer_a), dot(normal_at(b, viewer_b), viewer_b));
  float slope = sqrt(max(1.0 - facing * facing, 0.0)) / max(facing, 0.01);
  float jump = abs(depth_a - depth_b) - length(vec2(a - b)) * pixel_size_at(nearer) * slope;
  float missing = 1.0 - smoothstep(least, least + 3.0, jump);
  return 1.0 - missing * missing;  // as the eye sees it, about
}

bool parts_differ(ivec2 a, ivec2 b) {
  return params.has_parts != 0u && texelFetch(part_texels, index_of(a)).x != texelFetch(part_texels, index_of(b)).x;
}

// Share of a pixel that lines cover, and the depth of what they outline.
struct Ink {
  float covered;
  float depth;
};

// A line is `silhouettes` wide, half on each side of where it belongs. Software GL runs every branch: so each pixel
// first looks, cheaply, for the next neighbour that matters to it.
Ink ink_on(ivec2 pixel, float depth) {
  int reach = int(ceil(0.5 * params.silhouettes + 0.5));
  Ink ink = Ink(0.0, depth);
  ivec2 offset = ivec2(-reach - 1, -reach);
  do {
    ivec2 other;
    float share;
    float other_depth;
    bool step;
    bool seam;
    do {
      ++offset.x;
      if (offset.x > reach) offset = ivec2(-reach, offset.y + 1);
      other = pixel + offset;
      other_depth = depth_at(other);
      share = clamp(0.5 * params.silhouettes + 1.0 - length(vec2(offset)), 0.0, 1.0);
      bool counts = offset.y <= reach && share > ink.covered && in_block(other);
      step = counts && may_step(depth, other_depth);
      seam = counts && depth != kNothing && other_depth != kNothing && parts_differ(pixel, other);
    } while (!step && !seam && offset.y <= reach);
    float strength = seam ? 1.0 : step ? step_ink(pixel, depth, other, other_depth) : 0.0;
    if (share * strength > ink.covered) ink = Ink(share * strength, min(depth, other_depth));
  } while (offset.y <= reach);
  return ink;
}

// What is left of a colour at this depth.
float clarity(float depth) {
  float range = max(params.last_depth - params.first_depth, 1e-3);
  return 1.0 - params.depth_cue * clamp((depth - params.first_depth) / range, 0.0, 1.0);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (!in_block(pixel)) return;
  int at = index_of(pixel);
  vec4 color = samples[at];
  float depth = depth_at(pixel);
#ifdef AMBIENT_OCCLUSION
  if (depth != kNothing) color.rgb *= mix(1.0, mean_visibility(pixel, depth), params.ambient_occlusion);
#endif
  if (depth != kNothing) color *= clarity(depth);
#ifdef SILHOUETTES
  Ink ink = ink_on(pixel, depth);
  float covered = ink.covered * clarity(ink.depth);
  color = vec4(color.rgb * (1.0 - covered), mix(color.a, 1.0, covered));
#endif
  picture[at] = params.sample_index == 0u ? color : picture[at] + color;
}
