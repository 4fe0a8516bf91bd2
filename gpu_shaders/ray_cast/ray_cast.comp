// SPDX-License-Identifier: BSD-3-Clause
// Ray casts one block of the picture: a group is a tile of 16 x 16 pixels, an invocation one ray of one sample.
//
// The host gives each tile the primitives that may show in it, sorted by their nearest distance; a ray stops at the first
// one that begins behind its hit. The first sample goes through the pixel's centre and writes the exact point too.
#version 450 core
layout(local_size_x = 16, local_size_y = 16) in;

#define real float
#define real2 vec2
#define real3 vec3
#define GEOMETRY
#define GEOMETRY_OUT(type) out type
#include "gpu_shaders/geometry/ray_sphere.glsl"
#include "gpu_shaders/geometry/ray_torus.glsl"
#include "gpu_shaders/geometry/patch_membership.glsl"
#include "gpu_shaders/ray_cast/records.glsl"

layout(std430, binding = 0) readonly buffer Primitives { Primitive primitives[]; };
layout(std430, binding = 1) readonly buffer Rows { vec4 rows[]; };
layout(std430, binding = 2) readonly buffer Tiles { uint first_entry[]; };  // one more than there are tiles
layout(std430, binding = 3) readonly buffer Entries { uint entries[]; };
layout(std430, binding = 4) readonly buffer Colors { vec4 atom_color[]; };  // linear; three more for the kinds
layout(std430, binding = 5) buffer Picture { vec4 picture[]; };             // sums of linear, premultiplied samples
layout(std430, binding = 6) writeonly buffer Hits { Hit hits[]; };

uniform float probe_radius;
uniform float slack;
uniform ivec2 size;          // of this block, in pixels
uniform vec2 first_offset;   // of the block's first pixel centre from the picture's centre, in pixels
uniform vec2 sample_offset;  // of this sample from the pixel's centre
uniform uint sample_index;
uniform float pixel_size;    // on the pivot's plane, in Å
uniform float eye_distance;  // from the camera's position to the pivot's plane, in Å
uniform uint orthographic;
uniform vec3 right;
uniform vec3 up;
uniform vec3 forward;
uniform uint color_by_kind;
uniform uint atom_count;

#include "gpu_shaders/ray_cast/intersect.glsl"
#include "gpu_shaders/ray_cast/shade.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel.x >= size.x || pixel.y >= size.y) return;
  vec2 offset = first_offset + vec2(pixel) + sample_offset;
  vec3 lateral = right * (offset.x * pixel_size) - up * (offset.y * pixel_size);
  vec3 p = lateral;
  vec3 d = forward;
  float eye_t = -eye_distance;
  if (orthographic == 0u) {
    d = normalize(forward + lateral / eye_distance);
    eye_t = -eye_distance / dot(d, forward);
  }

  uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  const float kFar = 3.0e38;
  float best = kFar;
  uint best_primitive = kNoPrimitive;
  for (uint i = first_entry[tile]; i < first_entry[tile + 1u]; ++i) {
    uint index = entries[i];
    if (primitives[index].nearest + eye_t > best) break;
    float t = hit_primitive(primitives[index], p, d, eye_t, best);
    if (t < best) {
      best = t;
      best_primitive = index;
    }
  }

  vec4 color = vec4(0.0);
  Hit hit = Hit(vec3(0.0), 0.0, best_primitive, kNoPrimitive, 0u, 0u);
  if (best_primitive != kNoPrimitive) {
    Primitive primitive = primitives[best_primitive];
    SurfacePoint point = surface_point(primitive, p + d * best);
    hit = Hit(point.normal, best, best_primitive, point.atom, 0u, 0u);
    vec3 n = vec3(dot(point.normal, right), dot(point.normal, up), -dot(point.normal, forward));
    vec3 to_camera = -vec3(dot(d, right), dot(d, up), -dot(d, forward));
    if (dot(n, to_camera) < 0.0) n = -n;  // seen from inside the solid
    vec3 albedo = atom_color[color_by_kind != 0u ? atom_count + primitive.kind : point.atom].rgb;
    color = vec4(studio_light(albedo, n, to_camera), 1.0);
  }
  uint at = uint(pixel.y * size.x + pixel.x);
  if (sample_index == 0u) {
    picture[at] = color;
    hits[at] = hit;
  } else {
    picture[at] += color;
  }
}
