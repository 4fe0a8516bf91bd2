// SPDX-License-Identifier: BSD-3-Clause
// Stage "primitives", 1: a toroidal patch for every arc (RS edge).
// Reads: arcs, atoms, radii. Writes: primitives, rows, counters. One invocation per arc.
// Overflow: appends stop at the capacity but go on counting; the host grows and runs again.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.4.
#version 450 core
layout(local_size_x = 64) in;
#define DOUBLE_PRECISION
#include "gpu_shaders/shared/linear_index.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/geometry/circle.glsl"
#include "gpu_shaders/geometry/fixed_probe.glsl"
#include "gpu_shaders/reduced_surface/arc_ends.glsl"
#include "gpu_shaders/primitives/append_primitive.glsl"

layout(std140, binding = 0) uniform Parameters { ArcParameters params; };

// As in core/surface/fixed_probes.cpp.
const double kMergeDistance = 1e-6LF;
const double kTouchDistance = 1e-9LF;

// The part of the circle (i, j) that k covers, as the decisions saw it.
CoveredArc covered_by(uint k, uint i, Circle circle) {
  dvec3 q = atoms[k].xyz - atoms[i].xyz;
  return covered_arc(covered_half_plane(circle, atoms[i].w, q, length(q), atoms[k].w, kUnitRoundoff));
}

// Nothing or a whole turn? Positions cannot tell when the ends (nearly) coincide.
bool vanishes(uvec4 arc) {
  Circle decided = circle_of_two_spheres(atoms[arc.y].xyz - atoms[arc.x].xyz, atoms[arc.x].w, atoms[arc.y].w);
  return pseudo_sweep(covered_by(arc.z, arc.x, decided).end, covered_by(arc.w, arc.x, decided).begin) < 1.0LF;
}

void main() {
  uint index = linear_invocation_index();
  if (index >= params.arc_count) return;
  uvec4 arc = texelFetch(arcs, int(index));
  dvec3 origin = atoms[arc.x].xyz;
  dvec3 d = atoms[arc.y].xyz - origin;
  double ri = extended(arc.x, scene.probe_radius);
  double rj = extended(arc.y, scene.probe_radius);
  Circle circle = circle_of_two_spheres(d, ri * ri, rj * rj);
  // Touching spheres: the circle that the decisions saw.
  if (circle.radius_squared < 1e-12LF) circle = circle_of_two_spheres(d, atoms[arc.x].w, atoms[arc.y].w);
  dvec3 center = origin + circle.axis * circle.height;
  double major = circle.radius;
  // A circle as large as the probe touches its axis in one point; rounding must not open a spindle there.
  if (abs(major - scene.probe_radius) < kTouchDistance) major = scene.probe_radius;

  dvec3 start = circle.u;
  double cosine = 1.0LF;
  double sine = 0.0LF;
  dvec2 half_sweep = dvec2(-1.0LF, 0.0LF);  // a whole turn
  uint range = 0u;
  uint key = add_to_key(add_to_key(0u, arc.x), arc.y);
  if (arc.z != kNone) {
    Triple first = triple_at(arc.x, arc.y, arc.z, false);
    Triple last = triple_at(arc.x, arc.y, arc.w, true);
    key = add_to_key(add_to_key(key, triple_key(first, 0u)), triple_key(last, 0u));
    dvec3 begin = place_probe(first, scene.probe_radius).position;
    dvec3 end = place_probe(last, scene.probe_radius).position;
    dvec3 to_begin = begin - center;
    dvec3 to_end = end - center;
    start = normalize(to_begin - circle.axis * dot(to_begin, circle.axis));
    dvec3 stop = normalize(to_end - circle.axis * dot(to_end, circle.axis));
    cosine = dot(start, stop);
    sine = dot(circle.axis, cross(start, stop));
    half_sweep = half_angle(cosine, sine);
    range = sine > 0.0LF ? 1u : 2u;
    if (dot(begin - end, begin - end) < kMergeDistance * kMergeDistance) {
      if (vanishes(arc)) return;
      cosine = 1.0LF;
      sine = 0.0LF;
      half_sweep = dvec2(-1.0LF, 0.0LF);
      range = 0u;
    }
  }

  SaddleShape shape = saddle_shape(dot(origin - center, circle.axis), dot(atoms[arc.y].xyz - center, circle.axis),
                                   radii[arc.x], radii[arc.y], major, scene.probe_radius);
  PatchBound bound = saddle_bound(shape, center, circle.axis, start, major, half_sweep, scene.probe_radius);
  Primitive primitive;
  if (!begin_primitive(bound, 5u, primitive)) return;
  primitive.kind = kToroidal;
  primitive.plane_count = range;
  primitive.atom = arc.x;
  primitive.second_atom = arc.y;
  primitive.tie_key = key;
  add_row(center - scene.pivot, major);
  add_row(start, cosine);
  add_row(circle.axis, sine);
  add_row(dvec3(shape.contact_z[0], shape.contact_z[1], shape.clip_z), shape.clip_radius);
  add_row(dvec3(shape.height[0], shape.extended[0], shape.height[1]), shape.extended[1]);
  append_primitive(primitive);
}
