// SPDX-License-Identifier: BSD-3-Clause
// Where a fixed probe is: the point at three SAS radii from three atoms, as sharp as its numbers allow; and which
// probes are in one place.
//
// Common subset of GLSL and C++ with GLM, see circle.glsl, which is to be included first. Decimals are quotients of whole
// numbers, which are rounded once in any precision: GLSL takes 1e-6 for a float.
#ifndef MENISCUS_GEOMETRY_FIXED_PROBE_GLSL
#define MENISCUS_GEOMETRY_FIXED_PROBE_GLSL

// The most by which decisions grow a radius, Å (core/reduced_surface/reduced_surface.h).
const real kLargestGrowth = real(3) / real(2000000000);

// Squared height, Å², below which that growth may have moved a probe by its square root: such a probe is flat.
const real kFlat = real(1) / real(10000000);

// Probes this near are one probe with n contacts, Å.
const real kMergeDistance = real(1) / real(1000000);

// A probe lower than this, Å, moves so much more than its atoms that it must come nearer to be one with another.
const real kSteep = real(1) / real(100);

struct FixedProbe {
  real3 position;  // relative to the first atom
  real height;     // over the plane of the atoms
};

// One Newton step on the three distances removes what a slim triangle lost.
GEOMETRY real3 polished_probe(real3 x, real3 b, real3 c, real ra, real rb, real rc) {
  real3 eb = x - b;
  real3 ec = x - c;
  real3 residual = real3(dot(x, x) - ra * ra, dot(eb, eb) - rb * rb, dot(ec, ec) - rc * rc) * real(0.5);
  real3 bc = cross(eb, ec);
  real3 ca = cross(ec, x);
  real3 ab = cross(x, eb);
  return x - (bc * residual.x + ca * residual.y + ab * residual.z) / dot(x, bc);
}

// b, c: second and third atom relative to the first; ra, rb, rc: SAS radii; side: +1 for the probe on the side of
// cross(b, c), -1 for the other.
GEOMETRY FixedProbe fixed_probe(real3 b, real3 c, real ra, real rb, real rc, real side) {
  FixedProbe probe;
  real h2;
  probe.position = probe_of_three(b, c, ra * ra, rb * rb, rc * rc, side, h2);
  if (h2 < kFlat) {
    // Probe (almost) in the plane of its atoms: grown as the decision that found it was, but all alike, so that n-fold
    // contacts stay in one place.
    ra += kLargestGrowth;
    rb += kLargestGrowth;
    rc += kLargestGrowth;
    probe.position = probe_of_three(b, c, ra * ra, rb * rb, rc * rc, side, h2);
  } else {
    probe.position = polished_probe(probe.position, b, c, ra, rb, rc);
  }
  probe.height = sqrt(h2 > real(0) ? h2 : real(0));
  return probe;
}

// Whether two probes are in one place; d: from one to the other, height0 and height1: over the planes of their atoms.
GEOMETRY bool stand_together(real3 d, real height0, real height1) {
  real near = kMergeDistance * min(real(1), min(height0, height1) / kSteep);
  return dot(d, d) < near * near;
}

GEOMETRY bool is_flat(real height) { return height * height < real(2) * kFlat; }

// Whether they may be in one place although their positions are farther apart: one of them is flat, and its position
// blurred. They do if the other one touches all atoms of the flat one.
GEOMETRY bool may_stand_together(real3 d, real height0, real height1) {
  return dot(d, d) <= real(4) * kFlat && is_flat(height0) != is_flat(height1);
}

// d: from the probe to the atom's centre.
GEOMETRY bool touches_atom(real3 d, real sas_radius) { return abs(sqrt(dot(d, d)) - sas_radius) < kMergeDistance; }

#endif
