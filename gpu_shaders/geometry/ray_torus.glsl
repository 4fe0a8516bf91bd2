// SPDX-License-Identifier: BSD-3-Clause
// Where a ray meets a torus around the z axis: Newton's method on pieces of the ray where it cannot fail.
//
// Common subset of GLSL and C++ with GLM; the includer defines real, real2, real3, GEOMETRY, GEOMETRY_OUT and
// GEOMETRY_INOUT.
// A quartic in single precision loses roots when solved by radicals. Here no quartic is formed: it has the torus as a
// factor, |x|^2 + R^2 - p^2 - 2 R rho, which keeps all digits and whose turns along the ray are known.
#ifndef MENISCUS_GEOMETRY_RAY_TORUS_GLSL
#define MENISCUS_GEOMETRY_RAY_TORUS_GLSL

// Points x with |x|^2 + R^2 - p^2 = 2 R rho, rho = distance from the z axis. For R < p (spindle) this is the outer,
// apple part only: the lemon inside is the other factor of the quartic.
struct TorusFactors {
  real apple;        // |x|^2 + R^2 - p^2 - 2 R rho: zero on the torus (the apple), negative inside the tube
  real apple_slope;  // derivative of `apple` along the ray; on the axis, where it jumps, towards larger t or smaller t
};

// offset: R^2 - p^2; side: 1 or -1, as above.
GEOMETRY TorusFactors torus_factors(real3 o, real3 d, real major, real offset, real t, real side) {
  TorusFactors f;
  real3 x = o + d * t;
  real rho = sqrt(x.x * x.x + x.y * x.y);
  real a = dot(x, x) + offset;
  f.apple = a - real(2) * major * rho;
  real rho_slope = rho > real(0) ? (x.x * d.x + x.y * d.y) / rho : side * sqrt(d.x * d.x + d.y * d.y);
  f.apple_slope = real(2) * (dot(x, d) - major * rho_slope);
  return f;
}

// Newton's method towards the roots of the apple factor. Along the ray it is convex, then concave around the closest
// approach to the axis, then convex again; the bounds of the middle piece have a closed form. Where a convex function
// is positive, Newton's method walks towards a root without ever stepping over it, and sees when there is none.
struct TorusRuns {
  real knot[4];  // the three pieces: convex, concave, convex
  int sure;      // bits: the run ends at a root
  int waiting;   // bits: runs to be done, two for each piece: from its lower end up, then from its upper end down
};

GEOMETRY TorusRuns torus_runs(real3 o, real3 d, real major, real minor, real low, real high) {
  TorusRuns runs;
  real offset = (major - minor) * (major + minor);
  // rho^2 = h2 + s2 (t - middle)^2; the second derivative of the factor, 2 - 2 R h2 s2 / rho^3, vanishes at +-width.
  real s2 = d.x * d.x + d.y * d.y;
  real middle = s2 > real(0) ? -(o.x * d.x + o.y * d.y) / s2 : real(0);
  real x = o.x + d.x * middle;
  real y = o.y + d.y * middle;
  real h2 = x * x + y * y;
  real width_squared = pow(major * s2 * h2, real(2) / real(3)) - h2;
  real width = s2 > real(0) && width_squared > real(0) ? sqrt(width_squared / s2) : real(0);
  runs.knot[0] = low;
  runs.knot[1] = min(max(middle - width, low), high);
  runs.knot[2] = min(max(middle + width, low), high);
  runs.knot[3] = high;
  runs.sure = 0;
  runs.waiting = 0;
  TorusFactors at_low = torus_factors(o, d, major, offset, low, real(1));
  for (int piece = 0; piece < 3; ++piece) {
    TorusFactors at_high = torus_factors(o, d, major, offset, runs.knot[piece + 1], real(1));
    bool concave = piece == 1;
    bool low_above = (at_low.apple > real(0)) != concave;
    bool high_above = (at_high.apple > real(0)) != concave;
    bool descends = (at_low.apple_slope < real(0)) != concave;
    int up_run = 1 << (2 * piece);
    if (runs.knot[piece] < runs.knot[piece + 1]) {
      bool goes_up = low_above && (descends || !high_above);
      if (goes_up) runs.waiting |= up_run;
      if (goes_up && !high_above) runs.sure |= up_run;
      if (high_above && (!low_above || goes_up)) runs.waiting |= 2 * up_run;
    }
    at_low = at_high;
  }
  return runs;
}

// Does the next waiting run; `none` if it finds no root. Roots come in ascending order. tolerance: of t.
GEOMETRY real torus_run(real3 o, real3 d, real major, real minor, real tolerance, real none,
                        GEOMETRY_INOUT(TorusRuns) runs) {
  real offset = (major - minor) * (major + minor);
  int bit = runs.waiting & -runs.waiting;
  runs.waiting -= bit;
  bool down = (bit & 42) != 0;
  int piece = bit < 4 ? 0 : bit < 16 ? 1 : 2;
  real low = piece == 0 ? runs.knot[0] : piece == 1 ? runs.knot[1] : runs.knot[2];
  real high = piece == 0 ? runs.knot[1] : piece == 1 ? runs.knot[2] : runs.knot[3];
  real sign = piece == 1 ? real(-1) : real(1);
  // A run down is only started where there is a root.
  bool sure = down || (runs.sure & bit) != 0;
  real t = down ? high : low;
  real root = none;
  bool ended = bit == 0;
  int n = 0;
  do {
    TorusFactors f = torus_factors(o, d, major, offset, t, down ? real(-1) : real(1));
    real value = sign * f.apple;
    real slope = sign * f.apple_slope;
    if (down) slope = -slope;
    if (!ended && !(value > real(0))) {  // exactly on it, or a rounding past it
      root = t;
      ended = true;
    }
    if (!ended && !(slope < real(0))) {  // it turns before it comes to zero
      if (sure) root = t;
      ended = true;
    }
    if (!ended) {
      real walked = -value / slope;
      t = down ? t - walked : t + walked;
      bool outside = down ? t < low : t > high;
      // The next step would be about the square of this one over the slope.
      bool settled = real(8) * walked * walked <= -tolerance * slope || ++n == 60;
      if (outside) {
        if (sure) root = down ? low : high;
      } else if (settled) {
        root = t;
      }
      ended = outside || settled;
    }
  } while (!ended);
  if (!down && root == none) runs.waiting &= ~(2 * bit);  // then there is no second one either
  return root;
}

struct TorusHits {
  int count;  // 0 to 4, ascending
  real t[4];
};

// Points o + t*d, |d| = 1, t in [low, high], on the torus of major radius R and minor radius p around the z axis
// (without the lemon of a spindle torus). Precision: start the ray near the torus. tolerance: of t, about the roundoff.
GEOMETRY TorusHits ray_torus(real3 o, real3 d, real major, real minor, real low, real high, real tolerance) {
  TorusHits hits;
  hits.count = 0;
  hits.t[0] = hits.t[1] = hits.t[2] = hits.t[3] = high;
  real none = real(2) * abs(high) + real(1);
  TorusRuns runs = torus_runs(o, d, major, minor, low, high);
  while (runs.waiting != 0) {
    real root = torus_run(o, d, major, minor, tolerance, none, runs);
    if (root != none && hits.count < 4) hits.t[hits.count++] = root;
  }
  return hits;
}

#endif
