// SPDX-License-Identifier: BSD-3-Clause
// Computes the rays of a block's pixels.
//
// This file is written in GLSL and, as the body of a struct, in C++ (core/render/cpu), with the types of
// reduced_surface/precision.glsl. It must be included after the block `view` of BlockView.

// Returns the point where the ray through a place of the block meets the pivot's plane. place: pixels from the centre
// of the first pixel of the block.
GEOMETRY real3 ray_point_at(real2 place) {
  real2 offset = (view.first_offset + place + view.sample_offset) * view.pixel_size;
  return view.right * offset.x - view.up * offset.y;
}

GEOMETRY real3 ray_direction(real3 p) {
  if (view.orthographic != 0u) return real3(view.forward);
  return normalize(view.forward + p / view.eye_distance);
}

// Returns the ray parameter of the camera's position (orthographic: of the plane through it).
GEOMETRY real eye_parameter(real3 d) {
  if (view.orthographic != 0u) return real(-view.eye_distance);
  return -view.eye_distance / dot(d, view.forward);
}
