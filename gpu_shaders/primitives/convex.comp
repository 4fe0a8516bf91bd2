// SPDX-License-Identifier: BSD-3-Clause
// Stage "primitives", 7: makes a convex patch for every atom that has exposed arcs, or whose whole sphere is exposed.
// Reads: kept atoms and their neighbour lists, arcs by atom, clips, atoms, radii. Writes: primitives, rows, counters.
// One invocation per kept atom of the batch. Overflow: appends stop at the capacity but go on counting; the host grows
// and runs again.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.4.
#version 450 core
layout(local_size_x = 64) in;
#define DOUBLE_PRECISION
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/geometry/circle.glsl"
#include "gpu_shaders/reduced_surface/listed_balls.glsl"
#include "gpu_shaders/primitives/append_primitive.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(std430, binding = 0) readonly buffer Atoms { dvec4 atoms[]; };   // centre, decision weight
layout(std430, binding = 1) readonly buffer Radii { double radii[]; };  // van der Waals
layout(binding = 0) uniform usamplerBuffer atom_arc_first;
layout(binding = 1) uniform usamplerBuffer atom_arcs;  // partner, begin_by, end_by, mark
layout(std430, binding = 5) readonly buffer NeighborFirst { uint neighbor_first[]; };
layout(std430, binding = 6) readonly buffer NeighborLabels { uint neighbor_labels[]; };
layout(std140, binding = 0) uniform Parameters { ConvexParameters params; };
layout(std430, binding = 7) readonly buffer Clips { uint clips[]; };  // for whole spheres, not 0 if the sphere is drawn

// Returns the contact plane of atom a towards b, relative to the centre of a: unit normal, offset.
dvec4 contact_plane(uint a, uint b) {
  dvec3 d = atoms[b].xyz - atoms[a].xyz;
  double distance = length(d);
  return dvec4(d / distance, contact_height(distance, radii[a], radii[a] + scene.probe_radius,
                                            radii[b] + scene.probe_radius));
}

#ifdef WHOLE_SPHERES
// Makes the whole vdW sphere of an atom as in the paper. Most of it is inside the solid.
void make_patch(uint a, uint entry) {
  Primitive sphere;
  if (clips[a] == 0u || !begin_primitive(PatchBound(atoms[a].xyz, radii[a]), 1u, sphere)) return;
  sphere.kind = kConvex;
  sphere.plane_count = 0u;
  sphere.atom = a;
  sphere.tie_key = a;
  add_row(atoms[a].xyz - scene.pivot, radii[a]);
  append_primitive(sphere);
}
#else
// True if the sphere of an atom without arcs is exposed, which is then the whole sphere (theorem 4): no ball certainly
// overlaps it. Balls that touch it within rounding cover caps that are too small to cover a sphere together, and the
// border of any cap would be an exposed arc.
bool is_sphere_exposed(uint a, uint entry) {
  const double nearer = 1.0LF + 32.0LF * kUnitRoundoff;
  for (uint n = neighbor_first[entry]; n < neighbor_first[entry + 1u]; ++n) {
    dvec4 other = atoms[neighbor_labels[n]];
    if (balls_overlap(nearer * (other.xyz - atoms[a].xyz), atoms[a].w, other.w)) return false;
  }
  return true;
}

uint plane_count;
PatchBound bound;

// Adds a plane to the bound, or to the rows if `into_rows`.
void add_plane(uint a, uint b, bool into_rows) {
  dvec4 plane = contact_plane(a, b);
  if (into_rows) {
    add_row(plane.xyz, plane.w);
    return;
  }
  ++plane_count;
  PatchBound cap = cap_bound(atoms[a].xyz, radii[a], -plane.xyz, min(-plane.w / radii[a], 1.0LF));
  if (cap.radius < bound.radius) bound = cap;
}

void add_planes(uint a, uint entry, uint first, uint last, bool into_rows) {
  if (clips[a] == kByNeighbors) {
    for (uint n = neighbor_first[entry]; n < neighbor_first[entry + 1u]; ++n) add_plane(a, neighbor_labels[n], into_rows);
    return;
  }
  for (uint n = first; n < last; ++n) {
    uvec4 arc = texelFetch(atom_arcs, int(n));
    for (uint mark = arc.w; mark != 0u; mark &= mark - 1u) add_plane(a, arc[findLSB(mark)], into_rows);
  }
}

void make_patch(uint a, uint entry) {
  uint first = texelFetch(atom_arc_first, int(a)).x;
  uint last = texelFetch(atom_arc_first, int(a) + 1).x;
  if (clips[a] == kNotShown || (first == last && !is_sphere_exposed(a, entry))) return;
  plane_count = 0u;
  bound = PatchBound(atoms[a].xyz, radii[a]);
  add_planes(a, entry, first, last, false);
  Primitive primitive;
  if (begin_primitive(bound, 1u + plane_count, primitive)) {
    primitive.kind = kConvex;
    primitive.plane_count = plane_count;
    primitive.atom = a;
    primitive.tie_key = a;
    add_row(atoms[a].xyz - scene.pivot, radii[a]);
    add_planes(a, entry, first, last, true);
    append_primitive(primitive);
  }
  if (loops_cut_short()) cut_short = 1u;
}
#endif

void main() {
  uint entry = linear_invocation_index();
  // There is a single condition, because lavapipe of Mesa 22.3, which zink uses, crashes after a second return.
  if (entry >= min(params.entry_count, entries_of(params.atom_count) - params.first_entry)) return;
  make_patch(ball_of(params.first_entry + entry), entry);
}
