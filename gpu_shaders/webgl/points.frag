#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// What the point is like that a pixel's ray has met: its colour in the light, its normal, its depth, its atom.
#include "gpu_shaders/webgl/scene.glsl"

uniform usampler2D found_texels;  // of cast.frag
uniform usampler2D mark_texels;   // of atoms: Coloring::line_marks()
layout(location = 0) out uvec4 color;   // linear, premultiplied, as bits
layout(location = 1) out uvec4 normal;  // towards the solvent, and the depth along the view axis, as bits
layout(location = 2) out uvec4 what;    // atom, primitive, mark, t as bits

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec2 met = texelFetch(found_texels, pixel, 0).xy;
  color = uvec4(0u);
  normal = uvec4(0u, 0u, 0u, floatBitsToUint(kNothing));
  what = uvec4(kNoPrimitive, kNoPrimitive, 0u, floatBitsToUint(kMiss));
  if (met.y == kNoPrimitive) return;
  PixelRay ray = pixel_ray(pixel);
  float t = uintBitsToFloat(met.x);
  vec3 x = ray.p + ray.d * t;
  Primitive primitive = load_primitive(met.y);
  SurfacePoint point;
  if (primitive.kind == kCylinder) point = cylinder_point(primitive, x);
  else if (primitive.kind == kTriangle) point = triangle_point(primitive, x);
  else point = surface_point(primitive, x);
  bool by_kind = params.color_by_kind != 0u && primitive.kind < kCylinder;
  vec3 albedo = color_of(by_kind ? params.atom_count + primitive.kind : point.atom).rgb;
  color = floatBitsToUint(vec4(lit(albedo, point.normal, ray.d), 1.0));
  normal = floatBitsToUint(vec4(point.normal, view.eye_distance + t * dot(ray.d, view.forward)));
  what = uvec4(point.atom, met.y, entry(mark_texels, point.atom).x, met.x);
}
