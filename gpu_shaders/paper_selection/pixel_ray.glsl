// SPDX-License-Identifier: BSD-3-Clause
// The ray through the centre of a pixel, and the range of pixels that a group of 32 invocations tests for one ball.
#include "gpu_shaders/visibility/view.glsl"

struct PixelRay {
  vec3 origin;  // view coordinates
  vec3 direction;
};

PixelRay pixel_ray(ivec2 pixel) {
  vec2 slope = (vec2(pixel) + 0.5 - 0.5 * vec2(view.picture_size)) * view.pixel_scale;
  if (view.orthographic != 0u) return PixelRay(vec3(slope, 0.0), vec3(0.0, 0.0, 1.0));
  return PixelRay(vec3(0.0), normalize(vec3(slope, 1.0)));
}

struct PixelRange {
  ivec2 low;
  ivec2 size;
};

PixelRange pixels_of(vec3 v, float radius) {
  vec4 pixels = touched_pixels(v, radius);
  ivec2 low = ivec2(pixels.xy);
  return PixelRange(low, max(min(ivec2(pixels.zw), view.picture_size - 1) - low + 1, ivec2(0)));
}

ivec2 pixel_of(PixelRange range, int n) { return range.low + ivec2(n % range.size.x, n / range.size.x); }

uint pixel_index(ivec2 pixel) { return uint(pixel.y * view.picture_size.x + pixel.x); }
