// SPDX-License-Identifier: BSD-3-Clause
// Stage "neighbors": lists the atoms whose SAS balls overlap that of each atom, roughly nearest first. Pass 0 counts
// neighbours and pairs (i < j, both listed); pass 1 (after scans) writes them.
// Reads: atoms, atoms_low, cells. Writes: class_counts, neighbor_first, pair_first (counts, then scanned),
// neighbor_balls, neighbor_labels, pairs. One invocation per atom of the batch; entries after the last one have empty
// lists. Overflow: scans and pass 1 stop at the capacity; the host makes the frame again.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.3 (neighbourhood grid).
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/reduced_surface/cell_grid.glsl"
#include "gpu_shaders/reduced_surface/listed_balls.glsl"

layout(binding = 0) uniform usamplerBuffer atom_texels;                      // floats: high part of centre, SAS radius
layout(std430, binding = 0) buffer ClassCounts { uint class_counts[]; };     // per atom of the batch and class
layout(std430, binding = 1) readonly buffer AtomsLow { vec4 atoms_low[]; };  // low part of centre, 1 if swallowed
layout(std430, binding = 2) readonly buffer CellFirst { uint cell_first[]; };
layout(binding = 1) uniform usamplerBuffer cell_atoms;
layout(std430, binding = 3) buffer BallCount {
  uint cut_short;  // 1 if some ball has too many neighbours
  uint ball_count;
};
layout(std430, binding = 4) buffer NeighborFirst { uint neighbor_first[]; };
layout(std430, binding = 5) buffer PairFirst { uint pair_first[]; };
layout(std430, binding = 6) writeonly buffer NeighborBalls { vec4 neighbor_balls[]; };  // relative centre, SAS radius²
layout(std430, binding = 7) writeonly buffer NeighborLabels { uint neighbor_labels[]; };
layout(std140, binding = 0) uniform Parameters { NeighborParameters params; };

vec4 atom(uint index) { return uintBitsToFloat(texelFetch(atom_texels, int(index))); }

// The number of distance classes. Near balls cover most of a circle, so they should come first, and a few classes are
// nearly as good as sorting.
const uint kClasses = 6u;

void main() {
  uint entry = linear_invocation_index();
  if (entry >= params.entry_count) return;
  if (params.first_entry + entry >= entries_of(ball_count)) {
#if PASS == 0
    neighbor_first[entry] = 0u;
    pair_first[entry] = 0u;
#endif
    return;
  }
  uint i = ball_of(params.first_entry + entry);
  vec4 self = atom(i);
  vec4 self_low = atoms_low[i];
  bool swallowed = self_low.w > 0.5;
  float reach = self.w + params.largest_radius;
  ivec3 low = cell_of(self.xyz - reach);
  ivec3 high = cell_of(self.xyz + reach);
  ivec3 size = ivec3(grid.size.xyz);

  // Pass 0 counts each class; pass 1 turns the counts into places.
  uint class_next[kClasses];
#if PASS == 0
  for (uint c = 0u; c < kClasses; ++c) class_next[c] = 0u;
  uint pair_count = 0u;
#else
  uint next = neighbor_first[entry];
  for (uint c = 0u; c < kClasses; ++c) {
    class_next[c] = next;
    next += class_counts[entry * kClasses + c];
  }
#endif
  if (!swallowed) {
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        uint row = uint((z * size.y + y) * size.x);
        uint last = cell_first[row + uint(high.x) + 1u];
        for (uint n = cell_first[row + uint(low.x)]; n < last; ++n) {
          uint j = texelFetch(cell_atoms, int(n)).x;
          vec4 other = atom(j);
          vec3 coarse = other.xyz - self.xyz;
          float sum = other.w + self.w;
          float square = dot(coarse, coarse);
          // The margin is greater than the rounding. A ball that does not really overlap covers nothing and costs
          // little.
          if (square > sum * sum * 1.00001 || j == i) continue;
          vec4 other_low = atoms_low[j];
          if (other_low.w > 0.5) continue;
          uint c = min(uint(float(kClasses) * square / (sum * sum)), kClasses - 1u);
#if PASS == 0
          ++class_next[c];
          if (j > i && is_listed(j)) ++pair_count;
#else
          vec3 d = coarse + (other_low.xyz - self_low.xyz);
          if (class_next[c] < params.capacity) {
            neighbor_balls[class_next[c]] = vec4(d, other.w * other.w);
            neighbor_labels[class_next[c]] = j;
          }
          ++class_next[c];
#endif
        }
      }
    }
  }
#if PASS == 0
  if (loops_cut_short()) cut_short = 1u;
  uint neighbor_count = 0u;
  for (uint c = 0u; c < kClasses; ++c) {
    class_counts[entry * kClasses + c] = class_next[c];
    neighbor_count += class_next[c];
  }
  neighbor_first[entry] = neighbor_count;
  pair_first[entry] = pair_count;
#endif
}
