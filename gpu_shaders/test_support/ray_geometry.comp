// SPDX-License-Identifier: BSD-3-Clause
// Test kernel: the ray caster's geometry functions in single precision, with one query per invocation.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"

#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/geometry/ray_shapes.glsl"
#include "gpu_shaders/geometry/torus_hits.glsl"
#include "gpu_shaders/geometry/patch_membership.glsl"
#include "gpu_shaders/shared/parameters.glsl"

struct Query {
  vec4 origin_major;
  vec4 direction_minor;
};

struct Answer {
  vec4 torus_t;
  vec4 normal_at_first;  // w: number of torus hits
  vec4 sphere;           // near, far, found, unused
};

layout(std430, binding = 0) readonly buffer Queries { Query queries[]; };
layout(std430, binding = 1) writeonly buffer Answers { Answer answers[]; };
layout(std140, binding = 0) uniform Parameters { QueryParameters params; };

void main() {
  uint i = linear_invocation_index();
  if (i >= params.count) return;
  vec3 o = queries[i].origin_major.xyz;
  vec3 d = queries[i].direction_minor.xyz;
  float major = queries[i].origin_major.w;
  float minor = queries[i].direction_minor.w;
  TorusHits hits = ray_torus(o, d, major, minor, -20.0, 20.0, 2e-7);
  SphereHits sphere = ray_sphere(o, d, minor);
  Answer answer;
  answer.torus_t = vec4(hits.t[0], hits.t[1], hits.t[2], hits.t[3]);
  answer.normal_at_first = vec4(torus_normal(o + d * hits.t[0], major, minor), float(hits.count));
  answer.sphere = vec4(sphere.near_t, sphere.far_t, sphere.found ? 1.0 : 0.0, 0.0);
  answers[i] = answer;
}
