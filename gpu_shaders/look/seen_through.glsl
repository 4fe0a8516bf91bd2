// SPDX-License-Identifier: BSD-3-Clause
// Applies shade, depth cueing and lines of the first visible layer to the colours of all translucent layers.
// This file is in the common subset of GLSL and C++. Colours are linear and premultiplied unless noted otherwise.

// Returns the colours of all translucent layers with the first one finished. over: all translucent layers; first:
// colour (not premultiplied) and opacity of the first layer, which `over` includes; finished: the colour of the first
// layer after shade and depth cueing as if it were opaque.
vec4 with_finished_front(vec4 over, vec4 first, vec4 finished) {
  return over + first.w * (finished - vec4(vec3(first), float(1.0)));
}

// Returns a colour below a black line of this opacity.
vec4 under_ink(vec4 over, float covered) {
  return over * (float(1.0) - covered) + vec4(vec3(float(0.0)), covered);
}
