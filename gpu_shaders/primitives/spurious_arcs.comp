// SPDX-License-Identifier: BSD-3-Clause
// Stage "primitives", 6: tests if the atoms on arcs around an atom clip its patch exactly, or leave spurious arcs.
// Reads: arcs, lists of arcs by atom with marks, atoms. Writes: clips. One invocation per arc and side, which works on
// one arc of each circle and traverses the atom's partners once. It runs in single precision first, then in double
// precision for atoms in doubt. Overflow: none; if loops are cut short, all neighbours clip.
// Based on: Krone, Dachsbacher & Ertl 2010, section 3.4.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/reduced_surface/exposed_arcs.glsl"
#include "gpu_shaders/primitives/listed_arc.glsl"

layout(std430, binding = 0) readonly buffer Atoms { dvec4 atoms[]; };  // centre, decision weight

#ifdef DOUBLE_PRECISION
const uint kTestedClips = kInDoubt;
const uint kClipsInDoubt = kByNeighbors;
bool too_small(Circle c, real w0) { return false; }
#else
const uint kTestedClips = kByPartners;
const uint kClipsInDoubt = kInDoubt;
bool too_small(Circle c, real w0) { return c.radius_squared <= kSmallestCircle * kUnitRoundoff * w0; }
#endif

bool is_surface_arc(ListedArc listed, uvec3 border) {
  for (uint n = listed.first; n < listed.last; ++n)
    if (texelFetch(atom_arcs, int(n)).xyz == border) return true;
  return false;
}

// Finds the arcs of the circle (a, b) that the partners of atom a leave exposed.
void expose_among_partners(ListedArc listed, uint b) {
  dvec4 ball = atoms[listed.atom];
  real w0 = real(ball.w);
  dvec4 other = atoms[b];
  Circle c = circle_of_two_spheres(real3(other.xyz - ball.xyz), w0, real(other.w));
  begin_contour(c, w0, kUnitRoundoff);
  exposed_doubtful = too_small(c, w0);
  for (uint n = listed.first; n < listed.last && !contour_ended(); ++n) {
    uvec4 arc = texelFetch(atom_arcs, int(n));
    for (uint mark = arc.w; mark != 0u; mark &= mark - 1u) {
      uint q = arc[findLSB(mark)];
      if (q == b) continue;
      other = atoms[q];
      block(blocking_ball(real3(other.xyz - ball.xyz), real(other.w), w0), q);
    }
  }
}

// True if an exposed arc is not an arc of the surface, so that another atom must clip the patch.
bool is_spurious(ListedArc listed, uint b) {
  bool spurious = exposed_whole && !is_surface_arc(listed, uvec3(b, kNone, kNone));
  for (uint n = 0u; n < exposed_count && !spurious; ++n) {
    ExposedArc arc = get_arc(n);
    spurious = !is_surface_arc(listed, uvec3(b, arc.begin_by, arc.end_by));
  }
  return spurious;
}

void main() {
  ListedArc listed;
  if (!find_listed_arc(kTestedClips, listed)) return;
  uvec4 arc = texelFetch(atom_arcs, int(listed.place));
  if ((arc.w & kOnCircle) == 0u) return;
  expose_among_partners(listed, arc.x);
  if (exposed_doubtful) atomicMax(clips[listed.atom], kClipsInDoubt);
  else if (is_spurious(listed, arc.x)) clips[listed.atom] = kByNeighbors;
  if (loops_cut_short()) clips[listed.atom] = kByNeighbors;
}
