#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Computes the properties of the point that a pixel's ray has met: its lit colour, its normal, its depth, its atom.
#include "gpu_shaders/webgl/scene.glsl"

#ifdef LAYERS
uniform usampler2D event_texels;     // written by layer_event.frag
uniform usampler2D cap_atom_texels;  // written by cap_atom.frag
uniform vec4 cap_color;              // colour of caps; alpha 0: that of the atom
uniform vec4 hatching[kMostPlanes];  // stripes of each plane begin where dot(xyz, x) + w is whole; 0: none
uniform vec2 hatched_look;           // dark share of a stripe, and share of the light that is left there
uniform float surface_opacity;       // factor of the opacity of atoms
uniform float thickens;              // 1: the opacity is that of a thin film
#else
uniform usampler2D found_texels;  // written by cast.frag
#endif
uniform usampler2D mark_texels;   // marks of atoms: Coloring::line_marks()
#ifdef PAINTED
#include "gpu_shaders/webgl/painted.glsl"
#endif
const uint kHasOwnColors = 2u;   // the same as in exporters/page/page_tables.cpp
layout(location = 0) out uvec4 color;   // linear, premultiplied, as bits
layout(location = 1) out uvec4 normal;  // towards the solvent, and the depth along the view axis, as bits
layout(location = 2) out uvec4 what;    // atom, primitive, mark, t as bits

#ifdef LAYERS
SurfacePoint cap_point(ivec2 pixel, uint plane_number) {
  SurfacePoint point;
  point.normal = planes[plane_number].xyz;
  point.atom = texelFetch(cap_atom_texels, pixel, 0).x;
  return point;
}

vec3 on_cap(vec3 albedo, vec3 x, uint plane_number) {
  if (cap_color.a > 0.0) albedo = cap_color.rgb;
  vec4 stripes = hatching[plane_number];
  bool hatched = stripes.xyz != vec3(0.0) && fract(dot(stripes.xyz, x) + stripes.w) < hatched_look.x;
  return hatched ? hatched_look.y * albedo : albedo;
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
#ifdef LAYERS
  uvec4 met = texelFetch(event_texels, pixel, 0);
#else
  uvec2 met = texelFetch(found_texels, pixel, 0).xy;
#endif
  color = uvec4(0u);
  normal = uvec4(0u, 0u, 0u, floatBitsToUint(kNothing));
  what = uvec4(kNoPrimitive, kNoPrimitive, 0u, floatBitsToUint(kMiss));
  if (met.y == kNoPrimitive) return;
  PixelRay ray = pixel_ray(pixel);
  float t = uintBitsToFloat(met.x);
  vec3 x = ray.p + ray.d * t;
  SurfacePoint point;
  uint kind = kCylinder;  // any kind that is not a patch
  bool has_own_color = true;
#ifdef LAYERS
  if (met.y == kOnPlane) {
    point = cap_point(pixel, met.z);
  } else
#endif
  {
    Primitive primitive = load_primitive(met.y);
    kind = primitive.kind;
    has_own_color = (primitive.patch_index & kHasOwnColors) != 0u;
    if (kind == kCylinder) point = cylinder_point(primitive, x);
    else if (kind == kTriangle) point = triangle_point(primitive, x);
    else point = surface_point(primitive, x);
  }
  vec4 of_atom = color_of(point.atom);
  vec3 albedo = params.color_by_kind != 0u && !has_own_color ? color_of(params.atom_count + kind).rgb : of_atom.rgb;
#ifdef PAINTED
  bool is_patch = kind < kCylinder;
#ifdef LAYERS
  is_patch = is_patch || met.y == kOnPlane;
  float offset = met.y == kOnPlane ? 0.0 : map_scale.z;
#else
  float offset = map_scale.z;
#endif
  if (is_patch) albedo = painted(albedo, point.atom, x, point.normal, offset);
#endif
  uint mark = entry(mark_texels, point.atom).x;
  float alpha = 1.0;
#ifdef LAYERS
  if (met.y == kOnPlane) {
    albedo = on_cap(albedo, x, met.z);
    mark = (mark & ~3u) | (cap_color.a > 0.0 ? 1u : 0u);  // caps have no patches, and lines only between colours
  }
  alpha = of_atom.a * surface_opacity;
  if (thickens > 0.0 && alpha > 0.0 && alpha < 1.0) alpha = film_opacity(alpha, uintBitsToFloat(met.w));
#endif
  color = floatBitsToUint(vec4(lit(albedo, point.normal, ray.d), alpha));
  normal = floatBitsToUint(vec4(point.normal, view.eye_distance + t * dot(ray.d, view.forward)));
  what = uvec4(point.atom, met.y, mark, met.x);
}
