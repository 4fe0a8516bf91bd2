// SPDX-License-Identifier: BSD-3-Clause
// Tests by theorem 2 if any ball begins in front of the nearest vdW sphere on some ray.
#include "gpu_shaders/visibility/view.glsl"

layout(binding = 4) uniform usamplerBuffer tile_depths;   // floats
layout(binding = 5) uniform usamplerBuffer block_depths;  // floats

// The greatest number of blocks that are tested one by one, because drivers limit loops (dispatch.glsl).
const int kMostSteps = 8192;

// True if a ray of the picture may enter the ball in front of the vdW spheres. It returns false only if no ray does:
// rays are tested block by block, with bounds that hold for every ray of a block. position: relative to the middle of
// the atoms.
bool begins_in_front(vec3 position, float radius) {
  if (view.keep_all != 0u) return true;
  radius += view.margin;
  vec3 v = view_from_molecule(position);
  if (v.z + radius <= 0.0) return false;
  if (view.orthographic == 0u && dot(v, v) <= radius * radius) return true;
  vec4 pixels = touched_pixels(v, radius);
  if (pixels.x >= pixels.z || pixels.y >= pixels.w) return false;
  ivec2 last = view.picture_size - 1;
  ivec2 low = min(ivec2(pixels.xy), last);
  ivec2 high = min(ivec2(pixels.zw), last);
  ivec2 tiles = tile_count();
  int blocks = kTileEdge / view.block_edge;
  int steps = 0;
  for (int y = low.y / kTileEdge; y <= high.y / kTileEdge; ++y)
    for (int x = low.x / kTileEdge; x <= high.x / kTileEdge; ++x) {
      if (++steps > kMostSteps) return true;
      ivec2 tile = ivec2(x, y);
      float tile_depth = uintBitsToFloat(texelFetch(tile_depths, y * tiles.x + x).x);
      if (earliest_depth(ray_block(tile * kTileEdge, kTileEdge), v, radius) > tile_depth) continue;
      ivec2 first = max(low - tile * kTileEdge, ivec2(0)) / view.block_edge;
      ivec2 past = min(high - tile * kTileEdge, ivec2(kTileEdge - 1)) / view.block_edge + 1;
      for (int j = first.y; j < past.y; ++j)
        for (int i = first.x; i < past.x; ++i) {
          if (++steps > kMostSteps) return true;
          ivec2 block = tile * blocks + ivec2(i, j);
          float depth = uintBitsToFloat(texelFetch(block_depths, block.y * tiles.x * blocks + block.x).x);
          if (earliest_depth(ray_block(block * view.block_edge, view.block_edge), v, radius) <= depth) return true;
        }
    }
  return false;
}
