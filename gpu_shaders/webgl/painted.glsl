// SPDX-License-Identifier: BSD-3-Clause
// Colours points by a volume map. One table has its numbers: colours of the scale, the colour outside of the map, a
// number per atom that is 0 if the map colours it, and the values. It does the same as painted() in
// core/render/cpu/picture_content.cpp.
#ifndef MENISCUS_WEBGL_PAINTED_GLSL
#define MENISCUS_WEBGL_PAINTED_GLSL

uniform usampler2D map_texels;
uniform vec4 map_axes[3];   // a point's place along each axis: dot(xyz, x) + w
uniform vec3 map_size;      // points along each axis
uniform vec3 map_scale;     // x: value at the first colour; y: 1 / (value at the last one - x); z: sampling offset, Å
uniform vec3 map_parts;     // places in the table: x: colour outside of the map; y: numbers of atoms; z: values
uniform float map_is_shown; // 0: colours follow atoms

float map_number(uint n) { return uintBitsToFloat(entry(map_texels, n).x); }

real grid_value(uint n) { return map_number(uint(map_parts.z) + n); }

#include "gpu_shaders/geometry/trilinear.glsl"

vec3 map_color(uint first) { return vec3(map_number(first), map_number(first + 1u), map_number(first + 2u)); }

// Returns the linear colour of a point x. offset: distance from the surface at which the map is sampled, Å.
vec3 painted(vec3 of_atom, uint atom, vec3 x, vec3 normal, float offset) {
  if (map_is_shown == 0.0 || entry(map_texels, uint(map_parts.y) + atom).x != 0u) return of_atom;
  vec4 point = vec4(x + offset * normal, 1.0);
  vec3 place = vec3(dot(map_axes[0], point), dot(map_axes[1], point), dot(map_axes[2], point));
  uvec3 size = uvec3(map_size);
  if (!on_grid(place, size.x, size.y, size.z)) return map_color(uint(map_parts.x));
  float last = map_parts.x / 3.0 - 1.0;
  float t = clamp((trilinear(place, size.x, size.y, size.z) - map_scale.x) * map_scale.y, 0.0, 1.0);
  return map_color(3u * uint(t * last + 0.5));
}

#endif
