// SPDX-License-Identifier: BSD-3-Clause
// The uniform grid over atom centres, for all kernels that search for neighbours.
#include "gpu_shaders/shared/parameters.glsl"

layout(std140, binding = kCellGridBinding) uniform CellGridBlock { CellGrid grid; };

ivec3 cell_of(vec3 position) {
  return ivec3(clamp(floor((position - grid.low.xyz) * grid.low.w), vec3(0.0), grid.size.xyz - 1.0));
}

uint cell_index(ivec3 cell) {
  ivec3 size = ivec3(grid.size.xyz);
  return uint((cell.z * size.y + cell.y) * size.x + cell.x);
}
