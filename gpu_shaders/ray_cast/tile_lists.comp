// SPDX-License-Identifier: BSD-3-Clause
// Lists the primitives that may be visible in each tile, by slices of depth. The order within a slice is arbitrary.
// Pass 0: counts[slot of tile, kind and slice] += 1 for each tile that a primitive's bound touches.
// Pass 1: counts contain their prefix sums; each primitive takes the next place of its slot, so that in the end each
//         count is the end of its slot and the begin of the next one.
// Overflow: the scan and pass 1 stop at the capacity; the host makes the frame again.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/ray_cast/depth_slices.glsl"
#include "gpu_shaders/ray_cast/records.glsl"

layout(std140, binding = 0) uniform Parameters { TileListParameters params; };
layout(std140, binding = kDepthSlicesBinding) uniform SlicesBlock { DepthSlices slices; };
#include "gpu_shaders/ray_cast/bound_footprint.glsl"

layout(binding = 0) uniform usamplerBuffer primitive_texels;  // three texels each: struct Primitive
layout(std430, binding = 0) buffer Counts { uint counts[]; };
layout(std430, binding = 1) writeonly buffer Entries { uint entries[]; };
layout(std430, binding = 2) readonly buffer TileDepths { float tile_depth[]; };
layout(std430, binding = 3) readonly buffer PrimitiveCount { uint primitive_count; };

// Footprints that are too large for one invocation. The whole group shares them.
const int kNarrow = 64;
shared uint wide_count;
shared uint wide_primitive[64];
shared ivec4 wide_footprint[64];

void add_to_tile(uint primitive, float nearest, uint slot_in_tile, ivec2 tile) {
  ivec2 of_picture = params.first_tile + tile;
  if (params.bounded != 0u && nearest > tile_depth[of_picture.y * params.picture_tile_columns + of_picture.x]) return;
  uint place = atomicAdd(counts[kSlotsPerTile * uint(tile.y * params.tiles.x + tile.x) + slot_in_tile], 1u);
#if PASS == 1
  if (place < params.entry_capacity) entries[place] = primitive;
#endif
}

float nearest_of(uint primitive) {
  return uintBitsToFloat(texelFetch(primitive_texels, int(3u * primitive + 1u)).x);
}

uint slot_of(uint primitive) {
  uint kind = texelFetch(primitive_texels, int(3u * primitive + 1u)).w;
  return (kind == kToroidal ? kSliceCount : 0u) + slice_of(slices, nearest_of(primitive));
}

void main() {
  if (gl_LocalInvocationIndex == 0u) wide_count = 0u;
  barrier();
  uint primitive = linear_invocation_index();
  if (primitive < min(primitive_count, params.primitive_count)) {
    ivec4 footprint = bound_footprint(uintBitsToFloat(texelFetch(primitive_texels, int(3u * primitive))));
    float nearest = nearest_of(primitive);
    uint slot = slot_of(primitive);
    if ((footprint.y - footprint.x) * (footprint.w - footprint.z) > kNarrow) {
      uint place = atomicAdd(wide_count, 1u);
      wide_primitive[place] = primitive;
      wide_footprint[place] = footprint;
    } else {
      for (int y = footprint.z; y < footprint.w; ++y)
        for (int x = footprint.x; x < footprint.y; ++x) add_to_tile(primitive, nearest, slot, ivec2(x, y));
    }
  }
  barrier();
  for (uint n = 0u; n < wide_count; ++n) {
    ivec4 footprint = wide_footprint[n];
    float nearest = nearest_of(wide_primitive[n]);
    uint slot = slot_of(wide_primitive[n]);
    int width = footprint.y - footprint.x;
    int area = width * (footprint.w - footprint.z);
    for (int i = int(gl_LocalInvocationIndex); i < area; i += 64)
      add_to_tile(wide_primitive[n], nearest, slot, ivec2(footprint.x + i % width, footprint.z + i / width));
  }
}
