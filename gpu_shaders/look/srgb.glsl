// SPDX-License-Identifier: BSD-3-Clause
// Converts linear light to sRGB (IEC 61966-2-1).

vec3 srgb_from_linear(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, c * 12.92, lessThanEqual(c, vec3(0.0031308)));
}
