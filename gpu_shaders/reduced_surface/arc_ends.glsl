// SPDX-License-Identifier: BSD-3-Clause
// The fixed probes at the ends of an arc, in double precision; every arc that ends at a probe finds it in one place.
// To be included where real is double, below fixed_probe.glsl.
#include "gpu_shaders/ray_cast/tie_key.glsl"

layout(std430, binding = 0) readonly buffer Atoms { dvec4 atoms[]; };   // centre, decision weight
layout(std430, binding = 1) readonly buffer Radii { double radii[]; };  // van der Waals
layout(binding = 0) uniform usamplerBuffer arcs;                        // i, j, begin_by, end_by
uniform double exact_probe_radius;

const uint kNone = 0xffffffffu;
const double kLargestGrowth = 1.5e-9LF;  // of decision weights
const double kFlat = 1e-7LF;             // as in core/surface/fixed_probes.cpp

double extended(uint atom) { return radii[atom] + exact_probe_radius; }

// The atoms of a fixed probe, ascending; side 1: it stands on the side of cross(b - a, c - a).
struct Triple {
  uint a;
  uint b;
  uint c;
  uint side;
};

// Where the covered part of the circle (i, j), i < j, ends by k, the probe stands on the side of cross(j - i, k - i);
// where it begins, on the other.
Triple triple_at(uint i, uint j, uint k, bool at_end) {
  uint side = at_end ? 0u : 1u;
  if (k < i) return Triple(k, i, j, side);
  if (k < j) return Triple(i, k, j, side ^ 1u);
  return Triple(i, j, k, side);
}

FixedProbe place_probe(Triple t) {
  dvec3 origin = atoms[t.a].xyz;
  FixedProbe probe = fixed_probe(atoms[t.b].xyz - origin, atoms[t.c].xyz - origin, extended(t.a), extended(t.b),
                                 extended(t.c), t.side != 0u ? 1.0LF : -1.0LF, kLargestGrowth, kFlat);
  probe.position += origin;
  return probe;
}

// Names a fixed probe by its contacts, counter-clockwise seen from it; seed 0: as the ray caster names its patch.
uint triple_key(Triple t, uint seed) {
  uint key = add_to_key(seed, t.a);
  key = add_to_key(key, t.side != 0u ? t.b : t.c);
  return add_to_key(key, t.side != 0u ? t.c : t.b);
}
