// SPDX-License-Identifier: BSD-3-Clause
// The position of a fixed probe, which is the point at three SAS radii from three atoms, as accurately as its numbers
// allow; and a test if two probes are in one place.
//
// This file is in the common subset of GLSL and C++ with GLM, and follows circle.glsl. Decimal fractions are written as
// quotients of integers, which are rounded once in any precision; GLSL would take 1e-6 for a float.
#ifndef MENISCUS_GEOMETRY_FIXED_PROBE_GLSL
#define MENISCUS_GEOMETRY_FIXED_PROBE_GLSL

// The greatest growth of a radius in decisions, Å (core/reduced_surface/reduced_surface.h).
const real kLargestGrowth = real(3) / real(2000000000);

// A probe is flat if its squared height (Å²) is below this value. The growth of radii may have moved it by the square
// root of the growth.
const real kFlat = real(1) / real(10000000);

// Probes nearer to each other than this (Å) are one probe with n contacts.
const real kMergeDistance = real(1) / real(1000000);

// A probe lower than this (Å) moves much more than its atoms, so probes must be nearer to each other to be one.
const real kSteep = real(1) / real(100);

struct FixedProbe {
  real3 position;  // relative to the first atom
  real height;     // height over the plane of the atoms, Å
};

// Improves the position of a probe by one Newton step on its three distances, to correct slim triangles.
GEOMETRY real3 polished_probe(real3 x, real3 b, real3 c, real ra, real rb, real rc) {
  real3 eb = x - b;
  real3 ec = x - c;
  real3 residual = real3(dot(x, x) - ra * ra, dot(eb, eb) - rb * rb, dot(ec, ec) - rc * rc) * real(0.5);
  real3 bc = cross(eb, ec);
  real3 ca = cross(ec, x);
  real3 ab = cross(x, eb);
  return x - (bc * residual.x + ca * residual.y + ab * residual.z) / dot(x, bc);
}

// Returns the fixed probe of three atoms. b, c: second and third atom relative to the first; ra, rb, rc: SAS radii;
// side: +1 for the probe on the side of cross(b, c), -1 for the other.
GEOMETRY FixedProbe fixed_probe(real3 b, real3 c, real ra, real rb, real rc, real side) {
  FixedProbe probe;
  real h2;
  probe.position = probe_of_three(b, c, ra * ra, rb * rb, rc * rc, side, h2);
  if (h2 < kFlat) {
    // The probe is (almost) in the plane of its atoms. The radii grow as in the decision that found it, but all by the
    // same amount, so that n-fold contacts stay in one place.
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

// True if two probes are in one place. d: vector from one to the other; height0, height1: heights over the planes of
// their atoms.
GEOMETRY bool are_coincident(real3 d, real height0, real height1) {
  real near = kMergeDistance * min(real(1), min(height0, height1) / kSteep);
  return dot(d, d) < near * near;
}

GEOMETRY bool is_flat(real height) { return height * height < real(2) * kFlat; }

// True if two probes may be in one place although are_coincident() is false, because one of them is flat and its
// position inaccurate. They are in one place if the other one touches all atoms of the flat one.
GEOMETRY bool may_be_coincident(real3 d, real height0, real height1) {
  return dot(d, d) <= real(4) * kFlat && is_flat(height0) != is_flat(height1);
}

// True if a probe touches an atom. d: vector from the probe to the centre of the atom.
GEOMETRY bool touches_atom(real3 d, real sas_radius) { return abs(sqrt(dot(d, d)) - sas_radius) < kMergeDistance; }

#endif
