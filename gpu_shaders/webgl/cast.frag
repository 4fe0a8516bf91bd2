#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// Intersects the ray of a pixel with a primitive. The nearest point wins by its depth. TORI or SHAPES is defined for
// these kinds; otherwise the primitive is a clipped sphere. With LAYERS it finds the next hit of each ray behind the
// one in state_texels.
#ifdef GL_EXT_conservative_depth
#extension GL_EXT_conservative_depth : enable
#endif
#include "gpu_shaders/webgl/scene.glsl"

#ifdef GL_EXT_conservative_depth
layout(depth_greater) out highp float gl_FragDepth;
#endif

flat in uint index;
flat in vec4 bound;
uniform vec2 depth_range;  // see footprint.vert
layout(location = 0) out uvec2 found;  // t as bits, primitive

#ifdef LAYERS
uniform usampler2D state_texels;

bool is_new(Primitive primitive, PixelRay ray, float t) {
  uvec4 state = texelFetch(state_texels, ivec2(gl_FragCoord.xy), 0);
  if ((state.z & kHasHit) == 0u) return true;
  float side = dot(surface_point(primitive, ray.p + ray.d * t).normal, ray.d);
  return !is_repeated(t, side, uintBitsToFloat(state.x), uintBitsToFloat(state.y), params.slack);
}
#else
bool is_new(Primitive primitive, PixelRay ray, float t) { return true; }
#endif

bool on_patch(Primitive primitive, vec3 x, float radius) {
  uint end = primitive.first_row + 1u + primitive.plane_count;
  for (uint i = primitive.first_row + 1u; i < end; ++i) {
    vec4 plane = row(i);
    if (!in_half_space(x, plane.xyz, plane.w, params.slack)) return false;
  }
  return shows_sphere_point(primitive, x, radius);
}

float meet_clipped_sphere(Primitive primitive, PixelRay ray, float from) {
  vec4 place = row(primitive.first_row);
  SphereMeeting meeting = meet_sphere(place, ray.p, ray.d);
  if (!meeting.found) return kMiss;
  if (meeting.near_t > from && on_patch(primitive, meeting.near_point, place.w) && is_new(primitive, ray, meeting.near_t))
    return meeting.near_t;
  if (meeting.far_t > from && on_patch(primitive, meeting.far_point, place.w) && is_new(primitive, ray, meeting.far_t))
    return meeting.far_t;
  return kMiss;
}

float meet_torus(uint torus, PixelRay ray, float from) {
  TorusPatch saddle = load_torus(torus);
  LocalRay local = to_torus(saddle, ray.p, ray.d);
#ifdef LAYERS
  // The search begins where planes let the ray in, independently of earlier hits, because the begin affects the last
  // bits of the roots.
  local.low = max(local.low, kept_part(ray.p, ray.d, ray.eye_t).from - local.shift);
  if (!goes_towards_torus(local, kMiss)) return kMiss;
  TorusRuns runs = torus_runs(local.o, local.d, saddle.major, params.probe_radius, local.low, local.high);
  while (runs.waiting != 0) {
    float root = torus_run(local.o, local.d, saddle.major, params.probe_radius, 2e-7, kMiss, runs);
    float t = root + local.shift;
    if (root < kMiss && t > from && on_toroidal_patch(saddle, local.o + local.d * root) && is_new(saddle.primitive, ray, t))
      return t;
  }
  return kMiss;
#else
  local.low = max(local.low, from - local.shift);
  if (!goes_towards_torus(local, kMiss)) return kMiss;
  return hit_torus(saddle, local);
#endif
}

bool shows_shape(Primitive primitive, vec3 x) {
  if (!some_hidden) return true;
  return shows(primitive.kind == kCylinder ? cylinder_point(primitive, x).atom : triangle_point(primitive, x).atom);
}

float meet_shape(Primitive primitive, PixelRay ray, float from) {
  if (primitive.kind == kCylinder) {
    CylinderMeeting meeting = meet_cylinder(primitive, ray.p, ray.d);
    if (meeting.near_found && meeting.near_t > from && shows_shape(primitive, ray.p + ray.d * meeting.near_t))
      return meeting.near_t;
    bool far = meeting.far_found && meeting.far_t > from;
    return far && shows_shape(primitive, ray.p + ray.d * meeting.far_t) ? meeting.far_t : kMiss;
  }
  TriangleHit hit = meet_triangle(primitive, ray.p, ray.d);
  return hit.found && hit.t > from && shows_shape(primitive, ray.p + ray.d * hit.t) ? hit.t : kMiss;
}

void main() {
  PixelRay ray = pixel_ray(ivec2(gl_FragCoord.xy));
  if (misses_bound(bound.xyz, bound.w, ray.p, ray.d, ray.eye_t, 0.0, kMiss)) discard;
  float from = ray.eye_t;
#ifdef LAYERS
  uvec4 state = texelFetch(state_texels, ivec2(gl_FragCoord.xy), 0);
  if ((state.z & kEnded) != 0u) discard;
  from = uintBitsToFloat(state.x);
  if (dot(bound.xyz - ray.p, ray.d) + bound.w <= from) discard;
#endif
#if defined(TORI)
  float t = meet_torus(index, ray, from);
#elif defined(SHAPES)
  float t = meet_shape(load_primitive(index), ray, from);
#else
  float t = meet_clipped_sphere(load_primitive(index), ray, from);
#endif
  if (t == kMiss) discard;
  found = uvec2(floatBitsToUint(t), index);
  gl_FragDepth = clamp((t - ray.eye_t - depth_range.x) / (depth_range.y - depth_range.x), 0.0, 1.0);
}
