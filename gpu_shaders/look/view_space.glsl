// SPDX-License-Identifier: BSD-3-Clause
// Points of a cast block in the camera's axes: x right, y up, z towards the viewer, the eye (orthographic: its plane)
// at 0.
//
// GLSL and, as the body of a struct, C++ (core/render/cpu); to be included below the block `view` of BlockView. Words of
// shared/lane.glsl. The sources that use it ask the includer for depth_or_nothing() of a pixel, which may lie outside of
// the block, and hit_normal_at() of one that met something.

GEOMETRY truth in_block(integer2 pixel) {
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x < view.size.x && pixel.y < view.size.y;
}

// Å across one pixel at this depth.
GEOMETRY real pixel_size_at(real depth) {
  if (view.orthographic != 0u) return real(view.pixel_size);
  return view.pixel_size * (depth / view.eye_distance);
}

// From a picture's axes, which go right, down and away from the viewer, to the camera's, and back.
GEOMETRY real3 turned_over(real3 v) { return real3(v.x, -v.y, -v.z); }

// In the picture's axes: what is seen so many pixels right of and below its middle, where a pixel has this size.
GEOMETRY real3 seen_at(real2 place, real depth, real size) { return real3(place.x * size, place.y * size, depth); }

GEOMETRY real3 position_seen_at(real2 place, real depth) {
  return turned_over(seen_at(place, depth, pixel_size_at(depth)));
}

// From the picture's middle, in pixels.
GEOMETRY real2 place_of(integer2 pixel) { return view.first_offset + real2(pixel) + view.sample_offset; }

GEOMETRY real3 position_at(integer2 pixel, real depth) { return position_seen_at(place_of(pixel), depth); }

GEOMETRY real3 to_viewer_at(real3 position) {
  if (view.orthographic != 0u) return real3(0.0, 0.0, 1.0);
  return -normalize(position);
}

// A hit's normal towards the viewer's side, whichever side of the surface that is.
GEOMETRY real3 facing(real3 normal, real3 to_viewer) {
  real3 n = real3(dot(normal, view.right), dot(normal, view.up), -dot(normal, view.forward));
  return select(dot(n, to_viewer) < 0.0, -n, n);
}
