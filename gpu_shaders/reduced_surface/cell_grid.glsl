// SPDX-License-Identifier: BSD-3-Clause
// The uniform grid over atom centres, as all kernels that look for neighbours see it.

uniform vec4 grid_low;    // xyz: low corner, Å; w: 1 / cell edge
uniform vec4 grid_size;   // xyz: number of cells along each axis (whole numbers)

ivec3 cell_of(vec3 position) {
  return ivec3(clamp(floor((position - grid_low.xyz) * grid_low.w), vec3(0.0), grid_size.xyz - 1.0));
}

uint cell_index(ivec3 cell) {
  ivec3 size = ivec3(grid_size.xyz);
  return uint((cell.z * size.y + cell.y) * size.x + cell.x);
}
