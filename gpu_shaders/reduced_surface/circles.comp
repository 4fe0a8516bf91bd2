// SPDX-License-Identifier: BSD-3-Clause
// Stage "circles": finds the exposed arcs (RS edges) of the circle of each overlapping pair, or reports the circle as
// doubtful.
// Reads: circles (pairs, or in double the doubtful ones), neighbour lists, atoms. Writes: arcs, doubtful, counters. One
// invocation per circle. Overflow: appends stop at the capacity but go on counting; the host grows and runs again.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.3 (potential RS faces), by circles instead of triples.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/reduced_surface/exposed_arcs.glsl"
#include "gpu_shaders/reduced_surface/listed_balls.glsl"
#include "gpu_shaders/shared/parameters.glsl"

// The entry of atom i, and the place of j in its neighbour list.
layout(std430, binding = 0) readonly buffer Circles { uvec2 circles[]; };
layout(std430, binding = 1) readonly buffer NeighborFirst { uint neighbor_first[]; };
layout(std430, binding = 2) readonly buffer NeighborLabels { uint neighbor_labels[]; };
#ifdef DOUBLE_PRECISION
layout(std430, binding = 3) readonly buffer Atoms { dvec4 atoms[]; };  // centre, decision weight
#else
layout(std430, binding = 3) readonly buffer PairFirst { uint pair_first[]; };
layout(binding = 0) uniform usamplerBuffer neighbor_balls;  // floats: relative centre, SAS radius²
layout(std430, binding = 7) readonly buffer AtomsLow { vec4 atoms[]; };  // w: SAS radius
#endif
layout(std430, binding = 4) writeonly buffer Arcs { uvec4 arcs[]; };  // i, j, begin_by, end_by
layout(std430, binding = 5) writeonly buffer Doubtful { uvec2 doubtful[]; };
layout(std430, binding = 6) buffer Counters {
  uint arc_count;
  uint doubtful_counts[2];  // numbers in single and in double precision
};
layout(std140, binding = 0) uniform Parameters { CircleParameters params; };

#ifdef DOUBLE_PRECISION
const uint kPrecision = 1u;
uint circle_count() { return min(doubtful_counts[0], params.circle_count); }
#else
const uint kPrecision = 0u;
// Returns the number of circles, or 0 if there was no room for all neighbours. Some counted pairs are missing then.
uint circle_count() {
  bool complete = neighbor_first[params.entry_count] < params.list_limit;
  return complete ? min(pair_first[params.entry_count], params.circle_count) : 0u;
}
#endif

void append(uvec4 arc) {
  uint slot = atomicAdd(arc_count, 1u);
  if (slot < params.arc_capacity) arcs[slot] = arc;
}

// Gives the centre relative to atom i and the weight of the neighbour at place n.
void neighbor(uint i, uint n, out real3 center, out real weight) {
#ifdef DOUBLE_PRECISION
  dvec4 other = atoms[neighbor_labels[n]];
  center = other.xyz - atoms[i].xyz;
  weight = other.w;
#else
  vec4 ball = uintBitsToFloat(texelFetch(neighbor_balls, int(n)));
  center = ball.xyz;
  weight = ball.w;
#endif
}

void main() {
  uint index = linear_invocation_index();
  if (index >= circle_count()) return;
  uint entry = circles[index].x;
  uint i = ball_of(entry);
  uint place = circles[index].y;
#ifdef DOUBLE_PRECISION
  real w0 = atoms[i].w;
#else
  real w0 = atoms[i].w * atoms[i].w;
#endif
  real3 d;
  real w1;
  neighbor(i, place, d, w1);
  Circle c = circle_of_two_spheres(d, w0, w1);
  real unit = max(kUnitRoundoff, real(params.doubt));
  begin_contour(c, w0, unit);
  if (c.radius_squared < real(-1024) * unit * w0) return;  // the balls certainly do not overlap
  if (c.radius_squared <= max(kSmallestCircle * kUnitRoundoff, real(1024) * unit) * w0) {
    exposed_doubtful = true;
  } else {
    uint last = neighbor_first[entry - params.first_entry + 1u];
    for (uint n = neighbor_first[entry - params.first_entry]; n < last; ++n) {
      if (n == place) continue;
      real3 q;
      real wq;
      neighbor(i, n, q, wq);
      block(blocking_ball(q, wq, w0), n);  // the label is the place in the list; append() replaces it by the atom
      if (contour_ended()) break;
    }
    if (loops_cut_short()) exposed_doubtful = true;
  }
  if (exposed_doubtful) {
    uint slot = atomicAdd(doubtful_counts[kPrecision], 1u);
    if (slot < params.doubtful_capacity) doubtful[slot] = circles[index];
    return;
  }
  uint j = neighbor_labels[place];
  if (exposed_whole) append(uvec4(i, j, kNone, kNone));
  for (uint n = 0u; n < exposed_count; ++n) {
    ExposedArc arc = get_arc(n);
    append(uvec4(i, j, neighbor_labels[arc.begin_by], neighbor_labels[arc.end_by]));
  }
}
