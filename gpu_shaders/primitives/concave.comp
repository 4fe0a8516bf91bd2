// SPDX-License-Identifier: BSD-3-Clause
// Stage "primitives", 2: makes a concave patch for every fixed probe (RS face), cut by all probes that intersect it.
// Reads: probes, their neighbour lists, atoms. Writes: primitives, rows, counters. One invocation per probe of the
// batch. Overflow: appends stop at the capacity but go on counting; the host grows and runs again.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.4 (singularity handling), with every probe within two radii.
#version 450 core
layout(local_size_x = 64) in;
#define DOUBLE_PRECISION
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/geometry/circle.glsl"
#include "gpu_shaders/geometry/fixed_probe.glsl"
#include "gpu_shaders/geometry/polygon_reach.glsl"
#include "gpu_shaders/shared/parameters.glsl"
#include "gpu_shaders/primitives/append_primitive.glsl"

layout(std430, binding = 0) readonly buffer Atoms { dvec4 atoms[]; };  // centre, decision weight
layout(std430, binding = 1) readonly buffer Probes { ProbeRecord probes[]; };
layout(std430, binding = 5) readonly buffer NeighborFirst { uint neighbor_first[]; };
layout(std430, binding = 6) readonly buffer NeighborLabels { uint neighbor_labels[]; };
layout(std430, binding = 7) readonly buffer NeighborBalls { vec4 neighbor_balls[]; };  // centre relative to the probe
layout(std140, binding = 0) uniform Parameters { ConcaveParameters params; };

// Unit vectors towards the contacts, counter-clockwise seen from the probe. They are three variables, because NVIDIA's
// compiler (580.159) rounds doubles to floats in arrays with a variable index.
dvec3 contact_a;
dvec3 contact_b;
dvec3 contact_c;

// True if the bisector towards a probe at s + d cuts the spherical polygon.
bool cuts(dvec3 d) {
  double distance = length(d);
  if (!(distance > 0.0LF) || distance >= 2.0LF * scene.probe_radius) return false;
  PolygonReach reach = no_reach();
  dvec3 towards = d / distance;
  add_side(reach, contact_a, contact_b, towards);
  add_side(reach, contact_b, contact_c, towards);
  add_side(reach, contact_c, contact_a, towards);
  return reaches_bisector(reach, scene.probe_radius, distance);
}

bool touches(uint probe, uint atom) { return any(equal(probes[probe].atoms.xyz, uvec3(atom))); }

// True if a probe at `position` touches three atoms. The radii are those of decisions, which are larger by less than a
// hundredth of the tolerance.
bool touches_all(dvec3 position, uvec3 of) {
  return touches_atom(position - atoms[of.x].xyz, sqrt(atoms[of.x].w)) &&
         touches_atom(position - atoms[of.y].xyz, sqrt(atoms[of.y].w)) &&
         touches_atom(position - atoms[of.z].xyz, sqrt(atoms[of.z].w));
}

// True if the probe listed at `place` is a member of the same n-fold probe, so that there is no plane between them.
// Unlike core/surface/fixed_probes.cpp it does not require arcs that join them; docs/explanation/theory.md says why
// that is valid.
bool coincides(uint place, uint self) {
  vec3 coarse = neighbor_balls[place].xyz;
  if (dot(coarse, coarse) > 1e-6) return false;  // farther apart than may_be_coincident() allows
  ProbeRecord s = probes[self];
  ProbeRecord t = probes[neighbor_labels[place]];
  dvec3 d = t.position - s.position;
  if (are_coincident(d, s.height, t.height)) return true;
  if (!may_be_coincident(d, s.height, t.height)) return false;
  return is_flat(s.height) ? touches_all(t.position, s.atoms.xyz) : touches_all(s.position, t.atoms.xyz);
}

// True if contact n of the probe listed at `place` is a new contact of the n-fold probe of which it is a member. It is
// not new if the probe `self`, or a member listed before, touches this atom, too.
bool is_new_contact(uint self, uint first, uint place, int n) {
  uint atom = probes[neighbor_labels[place]].atoms[n];
  if (touches(self, atom)) return false;
  for (uint m = first; m < place; ++m)
    if (coincides(m, self) && touches(neighbor_labels[m], atom)) return false;
  return true;
}

void main() {
  uint entry = linear_invocation_index();
  if (entry >= params.probe_count) return;
  uint self = params.first_probe + entry;
  if (self >= probe_count) return;
  ProbeRecord probe = probes[self];
  dvec3 s = probe.position;
  uvec3 atom = probe.atoms.w != 0u ? probe.atoms.xyz : probe.atoms.xzy;
  contact_a = normalize(atoms[atom.x].xyz - s);
  contact_b = normalize(atoms[atom.y].xyz - s);
  contact_c = normalize(atoms[atom.z].xyz - s);
  dvec3 sum = contact_a + contact_b + contact_c;
  PatchBound bound = PatchBound(s, scene.probe_radius);
  if (length(sum) > 1e-6LF) {
    // A cap of at most half a sphere is convex on the sphere, so it contains the patch if it contains the contacts.
    dvec3 axis = normalize(sum);
    double cosine = min(min(dot(contact_a, axis), dot(contact_b, axis)), dot(contact_c, axis));
    bound = cap_bound(s, scene.probe_radius, axis, cosine);
  }

  // A patch leaves its simplex only if the probe is lower over its atoms than its radius (theorem 1.3).
  bool low = probe.height < scene.probe_radius;
  uint first = neighbor_first[entry];
  uint last = neighbor_first[entry + 1u];
  uint cut_count = 0u;
  uint contact_count = 3u;
  for (uint n = first; n < last; ++n) {
    bool same = coincides(n, self);
    if (low && !same && cuts(probes[neighbor_labels[n]].position - s)) ++cut_count;
    for (int m = 0; m < 3 && same; ++m)
      if (is_new_contact(self, first, n, m)) ++contact_count;
  }

  Primitive primitive;
  if (!begin_primitive(bound, 4u + cut_count + contact_count, primitive)) return;
  primitive.kind = kConcave;
  primitive.plane_count = 3u + cut_count;
  primitive.atom = contact_count;
  primitive.tie_key = probe.key;
  add_row(s - scene.pivot, scene.probe_radius);
  for (int n = 0; n < 3; ++n)
    add_row(normalize(cross(atoms[atom[n]].xyz - s, atoms[atom[n == 2 ? 0 : n + 1]].xyz - s)), 0.0LF);
  for (uint n = first; n < last; ++n) {
    dvec3 d = probes[neighbor_labels[n]].position - s;
    if (low && !coincides(n, self) && cuts(d)) add_row(normalize(d), 0.5LF * length(d));
  }
  add_bits(contact_a, atom.x);
  add_bits(contact_b, atom.y);
  add_bits(contact_c, atom.z);
  // A point has the colour of the nearest contact, and the other members of an n-fold probe have further contacts.
  for (uint n = first; n < last && contact_count > 3u; ++n) {
    if (!coincides(n, self)) continue;
    for (int m = 0; m < 3; ++m) {
      uint other = probes[neighbor_labels[n]].atoms[m];
      if (is_new_contact(self, first, n, m)) add_bits(normalize(atoms[other].xyz - s), other);
    }
  }
  append_primitive(primitive);
  if (loops_cut_short()) cut_short = 1u;
}
