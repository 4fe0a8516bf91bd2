// SPDX-License-Identifier: BSD-3-Clause
// Where a ray meets a torus around the z axis: the quartic, isolated by its derivatives, refined on the torus itself.
//
// Common subset of GLSL and C++ with GLM; the includer defines real, real2, real3, GEOMETRY and GEOMETRY_OUT.
// A quartic in single precision loses roots when solved by radicals. Here its derivatives, solved one after another,
// split the ray into pieces on which it is monotone (Collins & Akritas 1976 isolate roots that way; see also Yuksel
// 2022), and each root is refined on a factor of the quartic that keeps all digits.
#ifndef MENISCUS_GEOMETRY_RAY_TORUS_GLSL
#define MENISCUS_GEOMETRY_RAY_TORUS_GLSL

// Points x with |x|^2 + R^2 - p^2 = 2 R rho, rho = distance from the z axis. For R < p (spindle) this is the outer,
// apple part only: the lemon inside is the other factor of the quartic.
struct TorusFactors {
  real apple;        // |x|^2 + R^2 - p^2 - 2 R rho: zero on the torus (the apple), negative inside the tube
  real lemon;        // |x|^2 + R^2 - p^2 + 2 R rho: zero on the lemon, negative inside it; positive if R > p
  real apple_slope;  // derivative of `apple` along the ray
};

GEOMETRY TorusFactors torus_factors(real3 o, real3 d, real major, real offset, real t) {
  TorusFactors f;
  real3 x = o + d * t;
  real rho = sqrt(x.x * x.x + x.y * x.y);
  real a = dot(x, x) + offset;
  f.apple = a - real(2) * major * rho;
  f.lemon = a + real(2) * major * rho;
  real rho_slope = rho > real(0) ? (x.x * d.x + x.y * d.y) / rho : real(0);
  f.apple_slope = real(2) * (dot(x, d) - major * rho_slope);
  return f;
}

// Root of the cubic 4t^3 + 3 c.z t^2 + 2 c.y t + c.x between low and high, where it changes sign.
GEOMETRY real cubic_root_between(real3 c, real low, real high, bool rising, real tolerance) {
  real t = real(0.5) * (low + high);
  for (int i = 0; i < 60; ++i) {
    real value = ((real(4) * t + real(3) * c.z) * t + real(2) * c.y) * t + c.x;
    real slope = (real(12) * t + real(6) * c.z) * t + real(2) * c.y;
    if ((value > real(0)) == rising) high = t;
    else low = t;
    real next = t - value / slope;
    if (!(next > low && next < high)) next = real(0.5) * (low + high);
    real step = abs(next - t);
    t = next;
    if (step <= tolerance) break;
  }
  return t;
}

// Root of the apple factor between low and high, where it changes sign.
GEOMETRY real torus_root_between(real3 o, real3 d, real major, real offset, real low, real high, bool rising,
                                 real tolerance) {
  real t = real(0.5) * (low + high);
  for (int i = 0; i < 60; ++i) {
    TorusFactors f = torus_factors(o, d, major, offset, t);
    if ((f.apple > real(0)) == rising) high = t;
    else low = t;
    real next = t - f.apple / f.apple_slope;
    if (!(next > low && next < high)) next = real(0.5) * (low + high);
    real step = abs(next - t);
    t = next;
    if (step <= tolerance) break;
  }
  return t;
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
  real offset = (major - minor) * (major + minor);

  // f = (|x|^2 + offset)^2 - 4 R^2 rho^2 = t^4 + a3 t^3 + a2 t^2 + a1 t + a0; c holds a1, a2, a3.
  real od = dot(o, d);
  real k = dot(o, o) + offset;
  real r4 = real(4) * major * major;
  real3 c = real3(real(4) * od * k - real(2) * r4 * (o.x * d.x + o.y * d.y),
                  real(4) * od * od + real(2) * k - r4 * (d.x * d.x + d.y * d.y), real(4) * od);

  // Where f'' = 12 t^2 + 6 a3 t + 2 a2 vanishes, f' turns; f' has one root at most between two turns.
  real knot[4];
  real discriminant = real(9) * c.z * c.z - real(24) * c.y;
  real root = sqrt(discriminant > real(0) ? discriminant : real(0));
  knot[0] = low;
  knot[1] = min(max((real(-3) * c.z - root) / real(12), low), high);
  knot[2] = min(max((real(-3) * c.z + root) / real(12), low), high);
  knot[3] = high;

  // f is monotone between `start` and each following root of f'. Its sign is the product of its exact factors.
  real start = low;
  TorusFactors f_start = torus_factors(o, d, major, offset, low);
  real slope_low = ((real(4) * low + real(3) * c.z) * low + real(2) * c.y) * low + c.x;
  for (int i = 0; i < 4; ++i) {
    real end = high;
    if (i < 3) {
      real slope_high = ((real(4) * knot[i + 1] + real(3) * c.z) * knot[i + 1] + real(2) * c.y) * knot[i + 1] + c.x;
      bool turns = (slope_low > real(0)) != (slope_high > real(0)) && knot[i + 1] > knot[i];
      bool rising = slope_high > real(0);
      slope_low = slope_high;
      if (!turns) continue;
      end = cubic_root_between(c, knot[i], knot[i + 1], rising, real(16) * tolerance);
    }
    TorusFactors f_end = torus_factors(o, d, major, offset, end);
    if ((f_start.apple > real(0)) != (f_end.apple > real(0)))
      hits.t[hits.count++] =
          torus_root_between(o, d, major, offset, start, end, f_end.apple > real(0), tolerance);
    start = end;
    f_start = f_end;
  }
  return hits;
}

#endif
