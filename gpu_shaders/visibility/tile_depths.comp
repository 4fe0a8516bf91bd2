// SPDX-License-Identifier: BSD-3-Clause
// Stage "visible atoms", 2: finds the depth by which all rays of a tile have ended, for the quick half of later tests.
// Reads: block_depths. Writes: tile_depths. One invocation per tile. Overflow: none.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/visibility/view.glsl"

layout(std430, binding = 0) readonly buffer BlockDepths { uint block_depths[]; };
layout(std430, binding = 1) writeonly buffer TileDepths { float tile_depths[]; };

void main() {
  int index = int(linear_invocation_index());
  ivec2 tiles = tile_count();
  if (index >= tiles.x * tiles.y) return;
  ivec2 tile = ivec2(index % tiles.x, index / tiles.x);
  int blocks = kTileEdge / view.block_edge;
  uint latest = 0u;
  for (int y = 0; y < blocks; ++y)
    for (int x = 0; x < blocks; ++x) {
      ivec2 block = tile * blocks + ivec2(x, y);
      // Blocks outside of the picture have no rays.
      if (any(greaterThanEqual(block * view.block_edge, view.picture_size))) continue;
      latest = max(latest, block_depths[block.y * tiles.x * blocks + block.x]);
    }
  tile_depths[index] = uintBitsToFloat(latest);
}
