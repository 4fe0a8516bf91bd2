// SPDX-License-Identifier: BSD-3-Clause
// Patches overlap by a few roundings: along a border a ray meets two of them where there is one surface.
// Common subset of GLSL and C++.

// Whether a hit is that of the surface that the hit before it has met already. facing: below 0 where the ray goes in.
bool is_repeated(float t, float facing, float before_t, float before_facing, float slack) {
  if ((facing < float(0.0)) != (before_facing < float(0.0))) return false;
  return t - before_t <= float(8.0) * slack / max(abs(facing), float(0.01));
}
