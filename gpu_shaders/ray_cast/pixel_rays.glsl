// SPDX-License-Identifier: BSD-3-Clause
// The rays of a block's pixels.
//
// GLSL and, as the body of a struct, C++ (core/render/cpu); to be included below the block `view` of BlockView. Words of
// shared/lane.glsl.

// Where the ray through a place of the block, in pixels from the centre of its first one, meets the pivot's plane.
GEOMETRY real3 ray_point_at(real2 place) {
  real2 offset = (view.first_offset + place + view.sample_offset) * view.pixel_size;
  return view.right * offset.x - view.up * offset.y;
}

GEOMETRY real3 ray_direction(real3 p) {
  if (view.orthographic != 0u) return real3(view.forward);
  return normalize(view.forward + p / view.eye_distance);
}

// Parameter of the camera's position (orthographic: of the plane through it).
GEOMETRY real eye_parameter(real3 d) {
  if (view.orthographic != 0u) return real(-view.eye_distance);
  return -view.eye_distance / dot(d, view.forward);
}
