// SPDX-License-Identifier: BSD-3-Clause
// Detects repeated hits. Patches overlap by a few roundings, so near a border a ray may meet two of them where there is
// one surface. This file is written in the common subset of GLSL and C++.

// True if a hit repeats the hit before it on the same surface. facing: negative if the ray enters the solid.
bool is_repeated(float t, float facing, float before_t, float before_facing, float slack) {
  if ((facing < float(0.0)) != (before_facing < float(0.0))) return false;
  return t - before_t <= float(8.0) * slack / max(abs(facing), float(0.01));
}
