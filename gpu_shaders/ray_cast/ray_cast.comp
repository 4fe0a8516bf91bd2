// SPDX-License-Identifier: BSD-3-Clause
// Ray casts one sample of each pixel of a block. A group is a tile of 16 x 16 pixels, an invocation 2 x 2 of them.
//
// tile_lists.comp lists the primitives that may be visible in each tile, by slices of their nearest distance. Rays stop
// at the first slice that begins behind their hits. The first sample goes through the pixel's centre and writes the
// exact point. SOME_HIDDEN is defined if points of hidden atoms are not hits. Invocations whose loops a driver cuts
// short (long lists, dispatch.glsl) write only that they are unfinished. With RESUMED, these traverse their lists
// again, in one pass for each `part_length` entries.
#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;

#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/shared/dispatch.glsl"

#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/geometry/ray_shapes.glsl"
#include "gpu_shaders/geometry/ray_torus.glsl"
#include "gpu_shaders/geometry/patch_membership.glsl"
#include "gpu_shaders/ray_cast/depth_slices.glsl"
#include "gpu_shaders/ray_cast/records.glsl"

layout(binding = 0) uniform usamplerBuffer primitive_texels;  // three texels each: struct Primitive
layout(binding = 1) uniform usamplerBuffer row_texels;
layout(binding = 2) uniform usamplerBuffer slot_ends;  // the end of each slice of each tile (tile_lists.comp)
layout(binding = 3) uniform usamplerBuffer entries;
layout(binding = 4) uniform usamplerBuffer tile_order;  // the tile of each group (split_tiles.comp)
// Linear colours of atoms, then of the three kinds; alpha: opacity, 0 if hidden.
layout(std430, binding = 0) readonly buffer Colors { vec4 atom_color[]; };
layout(std430, binding = 1) buffer Picture { vec4 picture[]; };             // sums of linear, premultiplied samples
layout(std430, binding = 2) writeonly buffer Hits { Hit hits[]; };
layout(std430, binding = 3) buffer Unfinished {
  uint longest;         // length of the longest list of an unfinished invocation; 0 if there is none
  uint still_too_long;  // RESUMED: number of parts that were cut short again
  uint unfinished[];    // not 0 for unfinished invocations; 64 per tile
};

layout(std140, binding = 0) uniform Parameters { RayCastParameters params; };
layout(std140, binding = kDepthSlicesBinding) uniform SlicesBlock { DepthSlices slices; };
layout(std140, binding = kBlockViewBinding) uniform ViewBlock { BlockView view; };

vec4 row(uint index) { return uintBitsToFloat(texelFetch(row_texels, int(index))); }

vec4 bound_of(uint primitive) { return uintBitsToFloat(texelFetch(primitive_texels, int(3u * primitive))); }

float nearest_of(uint primitive) {
  return uintBitsToFloat(texelFetch(primitive_texels, int(3u * primitive + 1u)).x);
}

Primitive load_primitive(uint index) {
  uvec4 a = texelFetch(primitive_texels, int(3u * index + 1u));
  uvec4 b = texelFetch(primitive_texels, int(3u * index + 2u));
  return Primitive(bound_of(index), uintBitsToFloat(a.x), a.y, a.z, a.w, b.x, b.y, b.z, b.w);
}

ivec2 tile_origin;  // first pixel of this group's tile

// Returns pixel k of the four of this invocation. Consecutive invocations, which share a vector, fill squares.
ivec2 pixel_of(int k) {
  int i = int(gl_LocalInvocationIndex);
  ivec2 quad = ivec2((i & 3) | (i >> 1 & 4), (i >> 2 & 1) | (i >> 3 & 6));
  return tile_origin + 2 * quad + ivec2(k & 1, k >> 1);
}

#include "gpu_shaders/ray_cast/pixel_rays.glsl"

// Returns the point of ray k on the pivot's plane. Computing it again is cheaper than keeping it in an indexed array.
vec3 ray_point(int k) { return ray_point_at(vec2(pixel_of(k))); }

#ifdef SOME_HIDDEN
const bool some_hidden = true;
#else
const bool some_hidden = false;
#endif
truth shows(uint atom) { return atom_color[atom].a > 0.0; }

#include "gpu_shaders/ray_cast/patch_hits.glsl"
#include "gpu_shaders/ray_cast/intersect.glsl"
#include "gpu_shaders/ray_cast/studio_light.glsl"
#include "gpu_shaders/ray_cast/shade.glsl"

// The part of a tile's list that an invocation traverses, with the ray in the middle of its four.
struct Walk {
  int first;
  int end;
  vec3 p;
  vec3 d;
  float eye_t;
  float spread;  // distance from the middle ray to the others at the pivot's plane, Å
};

bool misses(vec4 bound, Walk walk, float farthest) {
  return misses_bound(bound.xyz, bound.w, walk.p, walk.d, walk.eye_t, walk.spread, farthest);
}

// Returns the place of the next primitive after `i` that one of the four rays may meet, or the end.
int next_candidate(Walk walk, int i, Nearest nearest) {
  float farthest = max(max(nearest.t.x, nearest.t.y), max(nearest.t.z, nearest.t.w));
  bool found = true;
  do {
    ++i;
    uint index = texelFetch(entries, i).x;
    // All later primitives begin no earlier than the slice of this one. Testing each would cost more than it saves.
    if (i < walk.end && ((i - walk.first) & 7) == 0 &&
        slice_begin(slices, slice_of(slices, nearest_of(index))) + walk.eye_t - walk.spread > farthest)
      i = walk.end;
    found = i >= walk.end || !misses(bound_of(index), walk, farthest);
  } while (!found);
  return min(i, walk.end);
}

void trace_spheres(Walk walk, inout Nearest nearest) {
  Rays rays;
  for (int k = 0; k < 4; ++k) {
    rays.p[k] = ray_point(k);
    rays.d[k] = ray_direction(rays.p[k]);
  }
  int i = next_candidate(walk, walk.first - 1, nearest);
  do {
    if (i < walk.end) {
      uint index = texelFetch(entries, i).x;
      hit_clipped_sphere(index, load_primitive(index), rays, nearest);
    }
    i = next_candidate(walk, i, nearest);
  } while (i < walk.end);
}

void trace_tori(Walk walk, inout Nearest nearest) {
  int i = walk.first - 1;
  uint index = 0u;
  uint waiting = 0u;  // bits of rays that may meet torus `index`
  do {
    if (waiting != 0u) {
      int k = findLSB(waiting);
      waiting &= waiting - 1u;
      hit_toroidal(index, k, nearest);
    }
    do {
      if (waiting == 0u && i < walk.end) {
        i = next_candidate(walk, i, nearest);
        if (i < walk.end) {
          index = texelFetch(entries, i).x;
          waiting = rays_towards_torus(index, nearest);
        }
      }
    } while (waiting == 0u && i < walk.end);
  } while (waiting != 0u);
}

Nearest no_hits() {
  Nearest nearest;
  nearest.t = vec4(kMiss);
  nearest.primitive = nearest.kind = nearest.tie_key = uvec4(kNoPrimitive);
  return nearest;
}

// Returns the list of a tile: spheres from x to y, tori from y to z.
ivec3 list_of(uint tile) {
  int slot = int(kSlotsPerTile * tile);
  return ivec3(tile == 0u ? 0 : int(texelFetch(slot_ends, slot - 1).x),
               int(texelFetch(slot_ends, slot + int(kSliceCount) - 1).x),
               int(texelFetch(slot_ends, slot + int(kSlotsPerTile) - 1).x));
}

// Finds the nearest hits of the four rays in a list. Software GL runs every branch for all lanes of a vector, so each
// invocation first advances to its next candidate by cheap tests, and then all of them test their candidates.
void trace(ivec3 list, inout Nearest nearest) {
  Walk walk;
  walk.p = 0.5 * (ray_point(0) + ray_point(3));
  walk.d = ray_direction(walk.p);
  walk.eye_t = eye_parameter(walk.d);
  // The four rays are half a pixel's diagonal from the middle. A slightly larger value covers their rounding.
  walk.spread = 0.75 * view.pixel_size;
  walk.first = list.x;
  walk.end = list.y;
  trace_spheres(walk, nearest);
  walk.first = list.y;
  walk.end = list.z;
  trace_tori(walk, nearest);
}

#ifdef RESUMED
struct State {
  vec4 t;
  uvec4 primitive;
  uvec4 kind;
  uvec4 tie_key;
};
layout(std430, binding = 4) buffer States { State states[]; };  // one per invocation, like `unfinished`

// Traces one part of the list. Returns true if the invocation has traversed its whole list. An invocation that is cut
// short again is resumed with shorter parts.
bool trace_part(uint tile, uint place, out Nearest nearest) {
  nearest = no_hits();
  if (params.part > 0)
    nearest = Nearest(states[place].t, states[place].primitive, states[place].kind, states[place].tie_key);
  ivec3 list = list_of(tile);
  int from = min(list.x + params.part * params.part_length, list.z);
  int to = min(from + params.part_length, list.z);
  trace(ivec3(from, clamp(list.y, from, to), to), nearest);
  if (loops_cut_short()) {
    atomicAdd(still_too_long, 1u);
    unfinished[place] = 2u;
    return false;
  }
  states[place] = State(nearest.t, nearest.primitive, nearest.kind, nearest.tie_key);
  return params.is_last_part != 0u;
}
#endif

void write_pixel(ivec2 pixel, vec3 p, float t, uint index) {
  vec4 color = vec4(0.0);
  Hit hit = Hit(vec3(0.0), 0.0, index, kNoPrimitive, 0u, 0u);
  if (index != kNoPrimitive) {
    vec3 d = ray_direction(p);
    Primitive primitive = load_primitive(index);
    SurfacePoint point = surface_point(primitive, p + d * t);
    hit = Hit(point.normal, t, index, point.atom, 0u, 0u);
    vec3 albedo = atom_color[params.color_by_kind != 0u ? params.atom_count + primitive.kind : point.atom].rgb;
    color = vec4(lit(albedo, point.normal, d), 1.0);
  }
  uint at = uint(pixel.y * view.size.x + pixel.x);
  if (params.add == 0u) {
    picture[at] = color;
    hits[at] = hit;
  } else {
    picture[at] += color;
  }
}

void main() {
  uint group = linear_group_index();
  uint tile_count = uint(params.tiles.x * params.tiles.y);
  uint tile = texelFetch(tile_order, int(min(group, tile_count - 1u))).x;
  tile_origin = kTileEdge * ivec2(int(tile) % params.tiles.x, int(tile) / params.tiles.x);
  if (group >= tile_count) return;
  uint place = 64u * tile + gl_LocalInvocationIndex;
#ifdef RESUMED
  if (unfinished[place] == 0u || (unfinished[place] == 2u && params.part > 0)) return;
  if (params.part == 0) unfinished[place] = 1u;
  Nearest nearest;
  if (!trace_part(tile, place, nearest)) return;
  unfinished[place] = 0u;
#else
  ivec3 list = list_of(tile);
  Nearest nearest = no_hits();
  trace(list, nearest);
  if (loops_cut_short()) {
    unfinished[place] = 1u;
    atomicMax(longest, uint(list.z - list.x));
    return;
  }
#endif
  for (int k = 0; k < 4; ++k) {
    ivec2 pixel = pixel_of(k);
    if (pixel.x < view.size.x && pixel.y < view.size.y)
      write_pixel(pixel, ray_point(k), nearest.t[k], nearest.primitive[k]);
  }
}
