// SPDX-License-Identifier: BSD-3-Clause
// Computes the extent of a sphere seen from the eye along one axis of the picture.
#ifndef MENISCUS_SHARED_TANGENT_SLOPES_GLSL
#define MENISCUS_SHARED_TANGENT_SLOPES_GLSL

// Returns the slopes x/z of the two lines through the eye that touch the circle around (x, z), widened by the possible
// rounding error.
vec2 tangent_slopes(float x, float z, float radius) {
  // Close to the eye the difference below would lose its digits. The circle fills the picture there anyway.
  if (z < 1.01 * radius) return vec2(-1e20, 1e20);
  float denominator = (z - radius) * (z + radius);
  float root = radius * sqrt(x * x + denominator);
  float margin = 1e-6 * (1.0 + z / (z - radius)) * (abs(x) * z + root);
  return vec2(x * z - root - margin, x * z + root + margin) / denominator;
}

#endif
