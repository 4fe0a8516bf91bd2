// SPDX-License-Identifier: BSD-3-Clause
// Test kernel: contour build-up in double precision, with one circle per invocation.
#version 450 core
layout(local_size_x = 64) in;
#define DOUBLE_PRECISION
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/reduced_surface/exposed_arcs.glsl"
#include "gpu_shaders/shared/parameters.glsl"

struct Answer {
  uvec4 counted;  // number of arcs, 1 if the circle is whole, 1 if it is in doubt, unused
  dvec2 ends[8];
  uvec2 labels[8];
};

layout(std430, binding = 0) readonly buffer Atoms { dvec4 atoms[]; };      // centre, weight
layout(std430, binding = 1) readonly buffer Circles { uvec4 circles[]; };  // i, j, begin and end of the neighbours of i
layout(std430, binding = 2) readonly buffer Neighbors { uint neighbors[]; };
layout(std430, binding = 3) writeonly buffer Answers { Answer answers[]; };
layout(std140, binding = 0) uniform Parameters { QueryParameters params; };

void main() {
  uint index = linear_invocation_index();
  if (index >= params.count) return;
  uvec4 circle = circles[index];
  dvec4 first = atoms[circle.x];
  dvec4 second = atoms[circle.y];
  begin_contour(circle_of_two_spheres(second.xyz - first.xyz, first.w, second.w), first.w, kUnitRoundoff);
  for (uint n = circle.z; n < circle.w && !contour_ended(); ++n) {
    dvec4 other = atoms[neighbors[n]];
    if (neighbors[n] != circle.y) block(blocking_ball(other.xyz - first.xyz, other.w, first.w), neighbors[n]);
  }
  answers[index].counted = uvec4(exposed_count, exposed_whole ? 1u : 0u, exposed_doubtful ? 1u : 0u, 0u);
  for (uint n = 0u; n < exposed_count; ++n) {
    ExposedArc arc = get_arc(n);
    answers[index].ends[n] = dvec2(arc.begin, arc.end);
    answers[index].labels[n] = uvec2(arc.begin_by, arc.end_by);
  }
}
