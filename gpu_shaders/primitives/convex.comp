// SPDX-License-Identifier: BSD-3-Clause
// Stage "primitives", 4: a convex patch for every atom with exposed arcs, or without any neighbour.
// Reads: kept atoms and their neighbour lists, arcs by atom, atoms, radii, depths. Writes: primitives, rows, counters.
// One invocation per kept atom of the batch. Overflow: appends stop at the capacity but go on counting; the host grows
// and runs again.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.4.
#version 450 core
layout(local_size_x = 64) in;
#define DOUBLE_PRECISION
#include "gpu_shaders/shared/linear_index.glsl"
#include "gpu_shaders/shared/loop_guard.glsl"
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/reduced_surface/exposed_arcs.glsl"
#include "gpu_shaders/reduced_surface/listed_balls.glsl"
#include "gpu_shaders/primitives/append_primitive.glsl"
#include "gpu_shaders/visibility/begins_in_front.glsl"

layout(std430, binding = 0) readonly buffer Atoms { dvec4 atoms[]; };   // centre, decision weight
layout(std430, binding = 1) readonly buffer Radii { double radii[]; };  // van der Waals
layout(binding = 0) uniform usamplerBuffer atom_arc_first;
layout(binding = 1) uniform usamplerBuffer atom_arcs;  // partner, begin_by, end_by, 0
layout(std430, binding = 5) readonly buffer NeighborFirst { uint neighbor_first[]; };
layout(std430, binding = 6) readonly buffer NeighborLabels { uint neighbor_labels[]; };
#include "gpu_shaders/reduced_surface/lone_atom.glsl"
layout(std140, binding = 0) uniform Parameters { ConvexParameters params; };
#ifdef WHOLE_SPHERES
layout(std430, binding = 7) readonly buffer Drawn { uint drawn[]; };
#endif

// The atoms whose contact circles clip the patch: those on arcs, unless they leave something spurious or are too many
// for this list; then all neighbours (theorem 1.1).
const uint kPartnerCapacity = 64u;
uint partners[kPartnerCapacity];
uint partner_count;
bool all_neighbors;

void add_partner(uint b) {
  if (b == kNone) return;
  for (uint n = 0u; n < partner_count; ++n)
    if (partners[n] == b) return;
  if (partner_count < kPartnerCapacity) partners[partner_count++] = b;
  else all_neighbors = true;
}

bool known(uint first, uint last, uvec3 border) {
  for (uint n = first; n < last; ++n)
    if (texelFetch(atom_arcs, int(n)).xyz == border) return true;
  return false;
}

// Whether the circle (a, b) shows an arc among the partners that is none of the surface: then some other atom is needed.
bool shows_spurious_arc(uint a, uint b, uint first, uint last) {
  Circle c = circle_of_two_spheres(atoms[b].xyz - atoms[a].xyz, atoms[a].w, atoms[b].w);
  begin_contour(c, atoms[a].w);
  for (uint n = 0u; n < partner_count; ++n) {
    uint q = partners[n];
    if (q == b) continue;
    block(blocking_ball(atoms[q].xyz - atoms[a].xyz, atoms[q].w, atoms[a].w), q);
    if (contour_ended()) break;
  }
  if (exposed_doubtful) return true;
  if (exposed_whole) return !known(first, last, uvec3(b, kNone, kNone));
  for (uint n = 0u; n < exposed_count; ++n)
    if (!known(first, last, uvec3(b, exposed_arcs[n].begin_by, exposed_arcs[n].end_by))) return true;
  return false;
}

// The contact plane towards b, from the centre of a: unit normal, offset.
dvec4 contact_plane(uint a, uint b) {
  dvec3 d = atoms[b].xyz - atoms[a].xyz;
  double distance = length(d);
  return dvec4(d / distance, contact_height(distance, radii[a], radii[a] + scene.probe_radius,
                                            radii[b] + scene.probe_radius));
}

void main() {
  uint entry = linear_invocation_index();
  // One condition: behind a second return lavapipe of Mesa 22.3, which zink draws by, ends with a segmentation fault.
  if (entry >= min(params.entry_count, entries_of(params.atom_count) - params.first_entry)) return;
  uint a = ball_of(params.first_entry + entry);
#ifdef WHOLE_SPHERES
  // As in the paper: all of the vdW sphere, most of it inside the solid.
  if (drawn[a] == 0u) return;
  Primitive sphere;
  if (!begin_primitive(PatchBound(atoms[a].xyz, radii[a]), 1u, sphere)) return;
  sphere.kind = kConvex;
  sphere.plane_count = 0u;
  sphere.atom = a;
  sphere.tie_key = a;
  add_row(atoms[a].xyz - scene.pivot, radii[a]);
  append_primitive(sphere);
  return;
#endif
  uint first = texelFetch(atom_arc_first, int(a)).x;
  uint last = texelFetch(atom_arc_first, int(a) + 1).x;
  if (first == last && !alone(a, entry)) return;
  // The patch lies on the vdW sphere itself.
  if (!begins_in_front(vec3(atoms[a].xyz - params.middle), float(radii[a]))) return;

  partner_count = 0u;
  all_neighbors = false;
  for (uint n = first; n < last; ++n) add_partner(texelFetch(atom_arcs, int(n)).x);
  uint circle_count = partner_count;
  for (uint n = first; n < last; ++n) {
    // Atoms at the ends of arcs have arcs too, but perhaps none that the view needs.
    uvec4 arc = texelFetch(atom_arcs, int(n));
    add_partner(arc.y);
    add_partner(arc.z);
  }
  for (uint n = 0u; n < circle_count && !all_neighbors; ++n)
    all_neighbors = shows_spurious_arc(a, partners[n], first, last);

  uint first_plane = all_neighbors ? neighbor_first[entry] : 0u;
  uint past_plane = all_neighbors ? neighbor_first[entry + 1u] : partner_count;
  dvec3 center = atoms[a].xyz;
  PatchBound bound = PatchBound(center, radii[a]);
  for (uint n = first_plane; n < past_plane; ++n) {
    dvec4 plane = contact_plane(a, all_neighbors ? neighbor_labels[n] : partners[n]);
    PatchBound cap = cap_bound(center, radii[a], -plane.xyz, min(-plane.w / radii[a], 1.0LF));
    if (cap.radius < bound.radius) bound = cap;
  }
  Primitive primitive;
  if (!begin_primitive(bound, 1u + past_plane - first_plane, primitive)) return;
  primitive.kind = kConvex;
  primitive.plane_count = past_plane - first_plane;
  primitive.atom = a;
  primitive.tie_key = a;
  add_row(center - scene.pivot, radii[a]);
  for (uint n = first_plane; n < past_plane; ++n) {
    dvec4 plane = contact_plane(a, all_neighbors ? neighbor_labels[n] : partners[n]);
    add_row(plane.xyz, plane.w);
  }
  append_primitive(primitive);
  if (loops_cut_short()) cut_short = 1u;
}
