// SPDX-License-Identifier: BSD-3-Clause
// Computes points of a cast block in the camera's axes: x right, y up, z towards the viewer, with the eye
// (orthographic: its plane) at 0.
//
// This file is written in GLSL and, as the body of a struct, in C++ (core/render/cpu), with the types of
// reduced_surface/precision.glsl. It must be included after the block `view` of BlockView. The sources that use it need
// depth_or_nothing() of a pixel, which may be outside of the block, and hit_normal_at() of a pixel that has a hit, from
// the includer.

GEOMETRY truth in_block(integer2 pixel) {
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x < view.size.x && pixel.y < view.size.y;
}

// Returns the size of a pixel at this depth in Å.
GEOMETRY real pixel_size_at(real depth) {
  if (view.orthographic != 0u) return real(view.pixel_size);
  return view.pixel_size * (depth / view.eye_distance);
}

// Converts between the picture's axes, which point right, down and away from the viewer, and the camera's axes.
GEOMETRY real3 turned_over(real3 v) { return real3(v.x, -v.y, -v.z); }

// Returns the point at a place of the picture in the picture's axes. place: pixels right of and below the middle of the
// picture; size: size of a pixel at this depth in Å.
GEOMETRY real3 seen_at(real2 place, real depth, real size) { return real3(place.x * size, place.y * size, depth); }

GEOMETRY real3 position_seen_at(real2 place, real depth) {
  return turned_over(seen_at(place, depth, pixel_size_at(depth)));
}

// Returns the place of a pixel relative to the middle of the picture, in pixels.
GEOMETRY real2 place_of(integer2 pixel) { return view.first_offset + real2(pixel) + view.sample_offset; }

GEOMETRY real3 position_at(integer2 pixel, real depth) { return position_seen_at(place_of(pixel), depth); }

GEOMETRY real3 to_viewer_at(real3 position) {
  if (view.orthographic != 0u) return real3(0.0, 0.0, 1.0);
  return -normalize(position);
}

// Returns the normal of a hit in the camera's axes, reversed if necessary so that it points to the viewer's side.
GEOMETRY real3 facing(real3 normal, real3 to_viewer) {
  real3 n = real3(dot(normal, view.right), dot(normal, view.up), -dot(normal, view.forward));
  return select(dot(n, to_viewer) < 0.0, -n, n);
}
