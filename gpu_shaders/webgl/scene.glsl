// SPDX-License-Identifier: BSD-3-Clause
// Includes the ray caster's shared sources for the tables of a page.
#ifndef MENISCUS_WEBGL_SCENE_GLSL
#define MENISCUS_WEBGL_SCENE_GLSL
#include "gpu_shaders/webgl/tables.glsl"
#include "gpu_shaders/geometry/ray_shapes.glsl"
#include "gpu_shaders/geometry/ray_torus.glsl"
#include "gpu_shaders/geometry/patch_membership.glsl"

uniform usampler2D row_texels;
uniform usampler2D color_texels;  // linear colours of atoms, then of the three kinds; alpha: opacity, 0 if hidden
layout(std140) uniform Parameters { RayCastParameters params; };

vec4 row(uint index) { return uintBitsToFloat(entry(row_texels, index)); }

vec4 color_of(uint index) { return uintBitsToFloat(entry(color_texels, index)); }

Primitive load_primitive(uint index) {
  uvec4 a = entry(primitive_texels, 3u * index + 1u);
  uvec4 b = entry(primitive_texels, 3u * index + 2u);
  return Primitive(uintBitsToFloat(entry(primitive_texels, 3u * index)), uintBitsToFloat(a.x), a.y, a.z, a.w, b.x, b.y,
                   b.z, b.w);
}

#ifdef SOME_HIDDEN
const bool some_hidden = true;
#else
const bool some_hidden = false;
#endif
truth shows(uint atom) { return color_of(atom).a > 0.0; }

#include "gpu_shaders/ray_cast/pixel_rays.glsl"
#include "gpu_shaders/ray_cast/patch_hits.glsl"
#include "gpu_shaders/ray_cast/studio_light.glsl"
#include "gpu_shaders/ray_cast/shade.glsl"
#include "gpu_shaders/ray_cast/shape_hits.glsl"

#ifdef LAYERS
const int kMostPlanes = 8;
uniform vec4 planes[kMostPlanes];  // points with dot(xyz, x) < w are kept
uniform float planes_there;
int plane_count() { return int(planes_there); }
vec4 plane(int i) { return planes[i]; }
#include "gpu_shaders/ray_cast/layers.glsl"
#include "gpu_shaders/ray_cast/repeated_hit.glsl"

// The flags in the third word of a ray's state in state_texels. The first two words are, as bits, the parameter t
// beyond which the next hit lies, and the facing of the hit at t.
const uint kHasHit = 1u;    // there is a hit at t
const uint kEnded = 2u;     // nothing more is visible on the ray
const uint kHasBegun = 4u;  // the ray has entered through a cap, or has met the surface
const uint kHasShown = 8u;  // something on the ray is visible
#endif

// The ray of a pixel, in the coordinates of the records.
struct PixelRay {
  vec3 p;
  vec3 d;
  float eye_t;
};

PixelRay pixel_ray(ivec2 pixel) {
  PixelRay ray;
  ray.p = ray_point_at(vec2(pixel));
  ray.d = ray_direction(ray.p);
  ray.eye_t = eye_parameter(ray.d);
  ray.p += pivot;
  return ray;
}

#endif
