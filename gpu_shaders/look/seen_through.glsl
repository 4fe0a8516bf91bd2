// SPDX-License-Identifier: BSD-3-Clause
// How shade, depth cueing and lines of what is seen first change the colours of all that is seen through.
// Common subset of GLSL and C++; colours are linear and premultiplied unless a comment says otherwise.

// over: all that is seen through; first: colour, not premultiplied, and opacity of what is seen first, which is part of it;
// finished: the same as the look leaves it if it were opaque.
vec4 with_finished_front(vec4 over, vec4 first, vec4 finished) {
  return over + first.w * (finished - vec4(vec3(first), float(1.0)));
}

// Under a black line of this opacity.
vec4 under_ink(vec4 over, float covered) {
  return over * (float(1.0) - covered) + vec4(vec3(float(0.0)), covered);
}
