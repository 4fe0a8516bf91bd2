// SPDX-License-Identifier: BSD-3-Clause
// Writes transparent pixels and empty hits for tiles that list no primitives.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/ray_cast/records.glsl"
#include "gpu_shaders/ray_cast/parameters.glsl"

layout(binding = 0) uniform usamplerBuffer tile_order;
layout(std430, binding = 1) writeonly buffer Picture { vec4 picture[]; };
layout(std430, binding = 2) writeonly buffer Hits { Hit hits[]; };

layout(std140, binding = 0) uniform Parameters { EmptyTilesParameters params; };

void main() {
  uint group = linear_group_index();
  int tile_count = params.tiles.x * params.tiles.y;
  if (group >= uint(tile_count)) return;
  int tile = int(texelFetch(tile_order, tile_count - 1 - int(group)).x);
  for (int n = 0; n < kTileEdge * kTileEdge / 64; ++n) {
    int i = 64 * n + int(gl_LocalInvocationIndex);
    ivec2 pixel = kTileEdge * ivec2(tile % params.tiles.x, tile / params.tiles.x) + ivec2(i % kTileEdge, i / kTileEdge);
    if (pixel.x < params.size.x && pixel.y < params.size.y) {
      int at = pixel.y * params.size.x + pixel.x;
      picture[at] = vec4(0.0);
      hits[at] = Hit(vec3(0.0), 0.0, kNoPrimitive, kNoPrimitive, 0u, 0u);
    }
  }
}
