// SPDX-License-Identifier: BSD-3-Clause
// Interpolates values between the points of a grid.
//
// This file is written in the common subset of GLSL and C++, where it is the body of a struct
// (core/volume/volume_grid.cpp). The includer provides
//   real grid_value(uint n)  the value of a point, with the last axis fastest.
// place: position in steps from the first point; x_count, y_count, z_count: numbers of points along the axes, at least
// two.

// True if a place is on the grid.
GEOMETRY bool on_grid(real3 place, uint x_count, uint y_count, uint z_count) {
  return place.x >= real(0) && place.y >= real(0) && place.z >= real(0) && place.x <= real(x_count - 1u) &&
         place.y <= real(y_count - 1u) && place.z <= real(z_count - 1u);
}

// Returns the value at a place on the grid, interpolated from the eight points around it.
GEOMETRY real trilinear(real3 place, uint x_count, uint y_count, uint z_count) {
  uint x = min(uint(place.x), x_count - 2u);
  uint y = min(uint(place.y), y_count - 2u);
  uint z = min(uint(place.z), z_count - 2u);
  real3 share = place - real3(real(x), real(y), real(z));
  real sum = real(0);
  for (uint corner = 0u; corner < 8u; ++corner) {
    uint right = corner & 1u;
    uint up = (corner >> 1) & 1u;
    uint back = corner >> 2;
    real weight = (right == 1u ? share.x : real(1) - share.x) * (up == 1u ? share.y : real(1) - share.y) *
                  (back == 1u ? share.z : real(1) - share.z);
    sum += weight * grid_value(((x + right) * y_count + y + up) * z_count + z + back);
  }
  return sum;
}
