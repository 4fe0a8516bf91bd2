// SPDX-License-Identifier: BSD-3-Clause
// Separates tiles that list primitives from empty ones, so that no group is started for an empty tile. On software GL a
// kernel cannot return early.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/ray_cast/depth_slices.glsl"

layout(binding = 0) uniform usamplerBuffer slot_ends;
layout(std430, binding = 0) writeonly buffer TileOrder { uint tile_order[]; };  // tiles with primitives, then empty
// Group counts {x, y, z} for tiles with primitives, then their number; the same for empty tiles. Both must be {0, 1, 1,
// 0} before.
layout(std430, binding = 1) buffer Dispatches { uint dispatches[8]; };

layout(std140, binding = 0) uniform Parameters { SplitTilesParameters params; };

const uint kLongestRow = 32768u;

void main() {
  uint tile = linear_invocation_index();
  if (tile >= params.tile_count) return;
  int slot = int(kSlotsPerTile * tile);
  uint first = tile == 0u ? 0u : texelFetch(slot_ends, slot - 1).x;
  bool empty = first == texelFetch(slot_ends, slot + int(kSlotsPerTile) - 1).x;
  uint at = empty ? 4u : 0u;
  uint place = atomicAdd(dispatches[at + 3u], 1u);
  tile_order[empty ? params.tile_count - 1u - place : place] = tile;
  atomicMax(dispatches[at], min(place + 1u, kLongestRow));
  atomicMax(dispatches[at + 1u], place / kLongestRow + 1u);
}
