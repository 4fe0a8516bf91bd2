// SPDX-License-Identifier: BSD-3-Clause
// Shade, air and ink on one sample of each pixel of a block, which is then added to the picture.
#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
#include "gpu_shaders/look/view_space.glsl"

layout(binding = 2) uniform usamplerBuffer visibility_texels;
layout(binding = 3) uniform usamplerBuffer part_texels;
layout(std430, binding = 0) readonly buffer Samples { vec4 samples[]; };  // linear, premultiplied
layout(std430, binding = 1) buffer Picture { vec4 picture[]; };

uniform float ambient_occlusion;  // 0: visibility_texels are not there
uniform float silhouettes;        // pixels
uniform float depth_cue;
uniform float first_depth;
uniform float last_depth;
uniform uint sample_index;
uniform uint has_parts;

const float kPartInk = 0.9;  // strength of the lines between parts

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

// How strong a line is drawn between two pixels for their depths: from none at a small step to full at a large one.
float step_ink(ivec2 a, float depth_a, ivec2 b, float depth_b) {
  if (depth_a == kNothing || depth_b == kNothing) return depth_a == depth_b ? 0.0 : 1.0;
  float jump = abs(depth_a - depth_b);
  float nearer = pixel_size_at(min(depth_a, depth_b));
  float least = 0.5 + 2.0 * nearer;
  if (jump < least) return 0.0;
  // What the slope of the flatter one explains is no step.
  vec3 viewer_a = to_viewer_at(position_at(a, depth_a));
  vec3 viewer_b = to_viewer_at(position_at(b, depth_b));
  float facing = max(dot(normal_at(a, viewer_a), viewer_a), dot(normal_at(b, viewer_b), viewer_b));
  jump -= length(vec2(a - b)) * nearer * sqrt(max(1.0 - facing * facing, 0.0)) / max(facing, 0.01);
  float missing = 1.0 - smoothstep(least, least + 3.0, jump);
  return 1.0 - missing * missing;  // as the eye sees it, about
}

uint part_at(ivec2 pixel) {
  uint atom = texelFetch(hit_texels, 2 * index_of(pixel) + 1).y;
  return texelFetch(part_texels, int(atom)).x;
}

bool parts_differ(ivec2 a, ivec2 b) { return has_parts != 0u && part_at(a) != part_at(b); }

// Share of a pixel that lines cover, and the depth of what they outline.
struct Ink {
  float covered;
  float depth;
};

// A line is `silhouettes` wide, half on each side of where it belongs.
Ink ink_on(ivec2 pixel, float depth) {
  int reach = int(ceil(0.5 * silhouettes + 0.5));
  Ink ink = Ink(0.0, depth);
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      ivec2 other = pixel + ivec2(x, y);
      float share = clamp(0.5 * silhouettes + 1.0 - length(vec2(x, y)), 0.0, 1.0);
      if (share <= ink.covered || !in_block(other)) continue;
      float other_depth = depth_at(other);
      float strength = step_ink(pixel, depth, other, other_depth);
      if (strength < kPartInk && depth != kNothing && other_depth != kNothing && parts_differ(pixel, other))
        strength = kPartInk;
      if (share * strength > ink.covered) ink = Ink(share * strength, min(depth, other_depth));
    }
  return ink;
}

// What is left of a colour at this depth.
float clarity(float depth) {
  return 1.0 - depth_cue * clamp((depth - first_depth) / max(last_depth - first_depth, 1e-3), 0.0, 1.0);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (!in_block(pixel)) return;
  int at = index_of(pixel);
  vec4 color = samples[at];
  float depth = depth_at(pixel);
  if (depth != kNothing && ambient_occlusion > 0.0)
    color.rgb *= mix(1.0, mean_visibility(pixel, depth), ambient_occlusion);
  if (depth != kNothing) color *= clarity(depth);
  if (silhouettes > 0.0) {
    Ink ink = ink_on(pixel, depth);
    float covered = ink.covered * clarity(ink.depth);
    color = vec4(color.rgb * (1.0 - covered), mix(color.a, 1.0, covered));
  }
  picture[at] = sample_index == 0u ? color : picture[at] + color;
}
