// SPDX-License-Identifier: BSD-3-Clause
// Stage "primitives", 1: makes a toroidal patch for every arc (RS edge).
// Reads: arcs, atoms, radii. Writes: primitives, rows, counters. One invocation per arc. Overflow: appends stop at the
// capacity but go on counting; the host grows and runs again.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.4.
#version 450 core
layout(local_size_x = 64) in;
#define DOUBLE_PRECISION
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/reduced_surface/arc_ends.glsl"
#include "gpu_shaders/geometry/rolling_arc.glsl"
#include "gpu_shaders/geometry/patch_membership.glsl"
#include "gpu_shaders/primitives/append_primitive.glsl"

layout(std430, binding = 5) readonly buffer ArcCount { uint arc_count; };
layout(std140, binding = 0) uniform Parameters { ArcParameters params; };

// Returns the arc that the ball of k covers on the circle of atom i, with the decision weights.
CoveredArc decided_arc(uint k, uint i, Circle circle) {
  return covered_by(circle, atoms[i].w, atoms[k].xyz - atoms[i].xyz, atoms[k].w);
}

// True if an arc is empty rather than (nearly) a whole turn. It uses double precision, where
// core/surface/fixed_probes.cpp uses quadruple precision; arc_vanishes() says when that matters.
bool is_empty_arc(uvec4 arc) {
  Circle decided = circle_of_two_spheres(atoms[arc.y].xyz - atoms[arc.x].xyz, atoms[arc.x].w, atoms[arc.y].w);
  return arc_vanishes(decided_arc(arc.z, arc.x, decided), decided_arc(arc.w, arc.x, decided));
}

// True if a probe touches all atoms of another one.
bool touches_all(dvec3 position, Triple t) {
  return touches_atom(position - atoms[t.a].xyz, extended(t.a, scene.probe_radius)) &&
         touches_atom(position - atoms[t.b].xyz, extended(t.b, scene.probe_radius)) &&
         touches_atom(position - atoms[t.c].xyz, extended(t.c, scene.probe_radius));
}

bool are_same_probe(Triple s, FixedProbe at_s, Triple t, FixedProbe at_t) {
  dvec3 d = at_s.position - at_t.position;
  if (are_coincident(d, at_s.height, at_t.height)) return true;
  if (!may_be_coincident(d, at_s.height, at_t.height)) return false;
  return is_flat(at_s.height) ? touches_all(at_t.position, s) : touches_all(at_s.position, t);
}

void main() {
  uint index = linear_invocation_index();
  if (index >= min(arc_count, params.arc_count)) return;
  uvec4 arc = texelFetch(arcs, int(index));
  dvec3 origin = atoms[arc.x].xyz;
  RollingArc rolling = whole_turn(origin, atoms[arc.y].xyz - origin, extended(arc.x, scene.probe_radius),
                                extended(arc.y, scene.probe_radius), atoms[arc.x].w, atoms[arc.y].w, scene.probe_radius);
  dvec2 half_sweep = dvec2(-1.0LF, 0.0LF);
  uint range = uint(kWholeTurn);
  uint key = add_to_key(add_to_key(0u, arc.x), arc.y);
  if (arc.z != kNone) {
    Triple first = triple_at(arc.x, arc.y, arc.z, false);
    Triple last = triple_at(arc.x, arc.y, arc.w, true);
    key = add_to_key(add_to_key(key, triple_key(first, 0u)), triple_key(last, 0u));
    FixedProbe begin = place_probe(first, scene.probe_radius);
    FixedProbe end = place_probe(last, scene.probe_radius);
    bool together = ends_coincide(begin.position, end.position);
    if ((together || are_same_probe(first, begin, last, end)) && is_empty_arc(arc)) return;
    rolling = part_between(rolling, begin.position, end.position);
    if (together) {
      rolling.cosine = 1.0LF;
      rolling.sine = 0.0LF;
    } else {
      half_sweep = half_angle(rolling.cosine, rolling.sine);
      range = uint(rolling.sine > 0.0LF ? kUpToHalfTurn : kOverHalfTurn);
    }
  }

  SaddleShape shape = saddle_shape(dot(origin - rolling.center, rolling.axis), dot(atoms[arc.y].xyz - rolling.center, rolling.axis),
                                   radii[arc.x], radii[arc.y], rolling.radius, scene.probe_radius);
  PatchBound bound = saddle_bound(shape, rolling.center, rolling.axis, rolling.start, rolling.radius, half_sweep,
                                  scene.probe_radius);
  Primitive primitive;
  if (!begin_primitive(bound, 5u, primitive)) return;
  primitive.kind = kToroidal;
  primitive.plane_count = range;
  primitive.atom = arc.x;
  primitive.second_atom = arc.y;
  primitive.tie_key = key;
  add_row(rolling.center - scene.pivot, rolling.radius);
  add_row(rolling.start, rolling.cosine);
  add_row(rolling.axis, rolling.sine);
  add_row(dvec3(shape.contact_z[0], shape.contact_z[1], shape.clip_z), shape.clip_radius);
  add_row(dvec3(shape.height[0], shape.extended[0], shape.height[1]), shape.extended[1]);
  append_primitive(primitive);
}
