// SPDX-License-Identifier: BSD-3-Clause
// Intersects a ray with a torus around the z axis, by Newton's method on pieces of the ray where it cannot fail.
//
// This file is written in the common subset of GLSL and C++ with GLM. The includer defines real, real2, real3,
// GEOMETRY, GEOMETRY_OUT and GEOMETRY_INOUT. The types of reduced_surface/precision.glsl may be packets in C++. Solving
// a quartic by radicals in single precision loses roots. No quartic is formed here: the torus is one of its factors,
// |x|^2 + R^2 - p^2 - 2 R rho, which keeps all digits and has known inflection points along the ray.
#ifndef MENISCUS_GEOMETRY_RAY_TORUS_GLSL
#define MENISCUS_GEOMETRY_RAY_TORUS_GLSL

// The torus consists of points x with |x|^2 + R^2 - p^2 = 2 R rho, where rho is the distance from the z axis. For R < p
// (spindle) this is the outer part only, the apple; the lemon inside is the other factor of the quartic.
struct TorusFactors {
  real apple;        // |x|^2 + R^2 - p^2 - 2 R rho: zero on the torus (the apple), negative inside the tube
  real apple_slope;  // derivative of `apple` along the ray; on the axis, where it jumps, towards larger t or smaller t
};

// Returns the factor of the torus and its slope at a point of the ray. offset: R^2 - p^2; side: 1 or -1, the direction
// of the one-sided derivative on the axis.
GEOMETRY TorusFactors torus_factors(real3 o, real3 d, real major, real offset, real t, real side) {
  TorusFactors f;
  real3 x = o + d * t;
  real rho = sqrt(x.x * x.x + x.y * x.y);
  real a = dot(x, x) + offset;
  f.apple = a - real(2) * major * rho;
  real rho_slope = select(rho > real(0), (x.x * d.x + x.y * d.y) / rho, side * sqrt(d.x * d.x + d.y * d.y));
  f.apple_slope = real(2) * (dot(x, d) - major * rho_slope);
  return f;
}

// The state of Newton's method for the roots of the apple factor. Along the ray the factor is convex, then concave
// around the closest approach to the axis, then convex again; the bounds of the middle piece have a closed form. Where
// a convex function is positive, Newton's method approaches a root without ever stepping over it, and detects that
// there is none.
struct TorusRuns {
  real knot[4];   // the three pieces: convex, concave, convex
  integer sure;     // bits: the run ends at a root
  integer waiting;  // bits: runs to be done, two for each piece: from its lower end up, then from its upper end down
};

GEOMETRY TorusRuns torus_runs(real3 o, real3 d, real major, real minor, real low, real high) {
  TorusRuns runs;
  real offset = (major - minor) * (major + minor);
  // rho^2 = h2 + s2 (t - middle)^2. The second derivative of the factor, 2 - 2 R h2 s2 / rho^3, is zero at middle +-
  // width.
  real s2 = d.x * d.x + d.y * d.y;
  real middle = select(s2 > real(0), -(o.x * d.x + o.y * d.y) / s2, real(0));
  real x = o.x + d.x * middle;
  real y = o.y + d.y * middle;
  real h2 = x * x + y * y;
  real width_squared = pow(major * s2 * h2, real(2) / real(3)) - h2;
  real width = select(s2 > real(0) && width_squared > real(0), sqrt(width_squared / s2), real(0));
  runs.knot[0] = low;
  runs.knot[1] = min(max(middle - width, low), high);
  runs.knot[2] = min(max(middle + width, low), high);
  runs.knot[3] = high;
  runs.sure = integer(0);
  runs.waiting = integer(0);
  TorusFactors at_low = torus_factors(o, d, major, offset, low, real(1));
  for (int piece = 0; piece < 3; ++piece) {
    TorusFactors at_high = at_low;
    if (some(runs.knot[piece] < runs.knot[piece + 1]))
      at_high = torus_factors(o, d, major, offset, runs.knot[piece + 1], real(1));
    bool concave = piece == 1;
    truth low_above = (at_low.apple > real(0)) != concave;
    truth high_above = (at_high.apple > real(0)) != concave;
    truth descends = (at_low.apple_slope < real(0)) != concave;
    truth there = runs.knot[piece] < runs.knot[piece + 1];
    truth goes_up = there && low_above && (descends || !high_above);
    truth goes_down = there && high_above && (!low_above || goes_up);
    int up_run = 1 << (2 * piece);
    runs.sure = runs.sure | select(goes_up && !high_above, integer(up_run), integer(0));
    runs.waiting = runs.waiting | select(goes_up, integer(up_run), integer(0)) | select(goes_down, integer(2 * up_run), integer(0));
    at_low = at_high;
  }
  return runs;
}

// Does the next waiting run, and returns its root or `none`. Roots are found in ascending order. tolerance: tolerance
// of t.
GEOMETRY real torus_run(real3 o, real3 d, real major, real minor, real tolerance, real none,
                        GEOMETRY_INOUT(TorusRuns) runs) {
  real offset = (major - minor) * (major + minor);
  integer bit = runs.waiting & -runs.waiting;
  runs.waiting = runs.waiting - bit;
  truth down = (bit & 42) != 0;
  real low = select(bit < 4, runs.knot[0], select(bit < 16, runs.knot[1], runs.knot[2]));
  real high = select(bit < 4, runs.knot[1], select(bit < 16, runs.knot[2], runs.knot[3]));
  real sign = select(bit == 4 || bit == 8, real(-1), real(1));
  // A run down is started only if there is a root.
  truth sure = down || (runs.sure & bit) != 0;
  real t = select(down, high, low);
  real root = none;
  truth ended = bit == 0;
  int n = 0;
  do {
    TorusFactors f = torus_factors(o, d, major, offset, t, select(down, real(-1), real(1)));
    real value = sign * f.apple;
    real slope = sign * select(down, -f.apple_slope, f.apple_slope);
    truth arrived = !ended && !(value > real(0));  // exactly on it, or a rounding past it
    root = select(arrived, t, root);
    ended = ended || arrived;
    truth turns = !ended && !(slope < real(0));  // the slope turns before the factor comes to zero
    root = select(turns && sure, t, root);
    ended = ended || turns;
    real walked = -value / slope;
    real next = select(down, t - walked, t + walked);
    truth outside = (down && next < low) || (!down && next > high);
    // The next step is about the square of this one divided by the slope.
    truth settled = real(8) * walked * walked <= -tolerance * slope || ++n == 60;
    root = select(!ended && outside && sure, select(down, low, high), root);
    root = select(!ended && settled && !outside, next, root);
    ended = ended || outside || settled;
    t = next;
  } while (some(!ended));
  // If a run up finds no root, there is no second one either.
  runs.waiting = select(!down && root == none, runs.waiting & ~(bit * 2), runs.waiting);
  return root;
}

#endif
