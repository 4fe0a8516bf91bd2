// SPDX-License-Identifier: BSD-3-Clause
// How much of the sky each hit sees over what else the picture shows: ground-truth ambient occlusion (Jimenez, Wu,
// Pesce & Jarabo 2016), the visible arc of each slice in closed form.
//
// Each pixel looks along a few directions only, which differ within blocks of 4 x 4 pixels in a fixed pattern
// (interleaved sampling, Keller & Heidrich 2001); finish.comp averages over such blocks, and nothing of it stays.
#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
#include "gpu_shaders/look/view_space.glsl"
#include "gpu_shaders/look/parameters.glsl"

layout(std430, binding = 0) writeonly buffer Visibility { float visibility[]; };

layout(std140, binding = 0) uniform Parameters { OcclusionParameters params; };

const int kSliceCount = 2;
const int kStepCount = 6;
const float kPi = 3.14159265;

// Places of 0 to 15 in a block such that each row, column and quarter has small and large ones (Bayer 1973).
uint pattern(ivec2 pixel) {
  uvec2 p = uvec2(pixel) & 3u;
  uint x = p.x ^ p.y;
  return (x & 1u) << 3 | (p.y & 1u) << 2 | (x & 2u) | (p.y & 2u) >> 1;
}

// Cosine of the horizon, seen from p, on the way along `step_direction`, at least `lowest`.
float horizon(ivec2 pixel, vec3 p, vec3 to_viewer, vec2 direction, float reach, float offset, float lowest) {
  float range = reach * pixel_size_at(-p.z);
  float highest = lowest;
  for (int k = 0; k < kStepCount; ++k) {
    // Closer steps near by, where small clefts are.
    float share = (float(k) + offset) / float(kStepCount);
    ivec2 other = pixel + ivec2(round(direction * max(share * share * reach, float(k) + 1.0)));
    if (!in_block(other)) continue;
    float depth = depth_at(other);
    if (depth == kNothing) continue;
    vec3 to_other = position_at(other, depth) - p;
    float distance = length(to_other);
    // What is far away shades less and less; a step at the radius would show as a rim.
    float weight = clamp((1.0 - distance / range) / 0.6, 0.0, 1.0);
    highest = max(highest, mix(lowest, dot(to_other, to_viewer) / max(distance, 1e-6), weight));
  }
  return highest;
}

// The cosine-weighted arc between the viewer's direction and the horizon at angle h, both in a slice where the normal
// is at angle n.
float arc(float h, float n) { return 0.25 * (cos(n) + 2.0 * h * sin(n) - cos(2.0 * h - n)); }

float sky_visibility(ivec2 pixel, float depth) {
  vec3 p = position_at(pixel, depth);
  vec3 to_viewer = to_viewer_at(p);
  vec3 normal = normal_at(pixel, to_viewer);
  float reach = min(params.radius / pixel_size_at(depth), params.longest_reach);
  if (reach < 1.0) return 1.0;
  uint place = (pattern(pixel) + 5u * params.sample_index) & 15u;
  float seen = 0.0;
  float open = 0.0;  // what it would see alone
  for (int s = 0; s < kSliceCount; ++s) {
    float angle = (float(s) + (float(place) + 0.5) / 16.0) * (kPi / float(kSliceCount));
    vec3 direction = vec3(cos(angle), sin(angle), 0.0);
    vec3 in_slice = direction - to_viewer * dot(direction, to_viewer);
    vec3 axis = normalize(cross(in_slice, to_viewer));
    vec3 projected = normal - axis * dot(normal, axis);
    float length_projected = length(projected);
    if (length_projected < 1e-4) continue;
    float n = acos(clamp(dot(projected, to_viewer) / length_projected, -1.0, 1.0));
    if (dot(in_slice, projected) < 0.0) n = -n;
    float offset = (float((place * 7u + uint(s) * 5u) & 15u) + 0.5) / 16.0;
    vec2 on_picture = vec2(direction.x, -direction.y);
    float ahead = horizon(pixel, p, to_viewer, on_picture, reach, offset, cos(n + 0.5 * kPi));
    float behind = horizon(pixel, p, to_viewer, -on_picture, reach, offset, cos(n - 0.5 * kPi));
    seen += length_projected * (arc(acos(clamp(ahead, -1.0, 1.0)), n) + arc(-acos(clamp(behind, -1.0, 1.0)), n));
    open += length_projected * (cos(n) + n * sin(n));
  }
  return clamp(seen / max(open, 1e-6), 0.0, 1.0);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (!in_block(pixel)) return;
  float depth = depth_at(pixel);
  visibility[index_of(pixel)] = depth == kNothing ? 1.0 : sky_visibility(pixel, depth);
}
