// SPDX-License-Identifier: BSD-3-Clause
// Where a fixed probe stands: the point at three SAS radii from three atoms, as sharp as its numbers allow.
//
// Common subset of GLSL and C++ with GLM, see circle.glsl, which is to be included first.
#ifndef MENISCUS_GEOMETRY_FIXED_PROBE_GLSL
#define MENISCUS_GEOMETRY_FIXED_PROBE_GLSL

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
// cross(b, c), -1 for the other; growth: the most by which decisions grow a radius, flat: the squared height below
// which that growth may have moved the probe by its square root.
GEOMETRY FixedProbe fixed_probe(real3 b, real3 c, real ra, real rb, real rc, real side, real growth, real flat_height) {
  FixedProbe probe;
  real h2;
  probe.position = probe_of_three(b, c, ra * ra, rb * rb, rc * rc, side, h2);
  if (h2 < flat_height) {
    // Probe (almost) in the plane of its atoms: grown as the decision that found it was, but all alike, so that n-fold
    // contacts stay in one place.
    ra += growth;
    rb += growth;
    rc += growth;
    probe.position = probe_of_three(b, c, ra * ra, rb * rb, rc * rc, side, h2);
  } else {
    probe.position = polished_probe(probe.position, b, c, ra, rb, rc);
  }
  probe.height = sqrt(h2 > real(0) ? h2 : real(0));
  return probe;
}

#endif
