// SPDX-License-Identifier: BSD-3-Clause
// Parameters that the host passes to the kernels of this stage, as uniform blocks of GLSL and structs of C++
// (core/gpu/kernel_records.h says how).
#ifndef MENISCUS_RAY_CAST_PARAMETERS_GLSL
#define MENISCUS_RAY_CAST_PARAMETERS_GLSL

// The view of a block of a picture, for one sample of each of its pixels.
struct BlockView {
  vec3 right;
  float eye_distance;  // distance from the camera's position to the pivot's plane, in Å
  vec3 up;
  float pixel_size;  // size of a pixel on the pivot's plane, in Å
  vec3 forward;
  uint orthographic;
  vec2 first_offset;   // offset of the block's first pixel centre from the picture's centre, in pixels
  vec2 sample_offset;  // offset of the sample from the pixel's centre
  ivec2 size;          // size of the block, in pixels
};
const int kBlockViewBinding = 1;

struct DepthSlices {
  float first_depth;          // begin of slice 0, which also takes everything that begins before it, in Å
  float slices_per_angstrom;  // 0: everything is in slice 0
};
const int kDepthSlicesBinding = 2;

struct TileListParameters {
  vec3 right;
  float eye_distance;  // distance from the camera's position to the pivot's plane, in Å
  vec3 up;
  float pixels_per_angstrom;  // scale on the pivot's plane
  vec3 forward;
  uint orthographic;
  vec2 block_center;  // the picture's centre in pixels of the block
  ivec2 tiles;        // columns and rows of the block
  ivec2 first_tile;   // first tile of the block in the picture
  int picture_tile_columns;
  uint bounded;  // 1: tile_depth has, for each tile of the picture, the greatest depth that its rays see
  uint primitive_count;  // upper bound; the GPU has the exact number
  uint entry_capacity;   // capacity of the lists
};

struct SplitTilesParameters {
  uint tile_count;
};

struct EmptyTilesParameters {
  ivec2 size;  // size of the block, in pixels
  ivec2 tiles;
};

struct RayCastParameters {
  vec3 key_direction;  // this and the next numbers are those of studio_light
  float key_strength;
  vec3 key_color;
  float key_share;
  vec3 fill_direction;
  float fill_share;
  vec3 fill_color;
  float specular;  // 0 if highlights are added after the shade
  vec3 sky;
  float ambient;
  vec3 ground;
  float roughness;
  ivec2 tiles;  // columns and rows
  float probe_radius;
  float slack;
  float shininess;
  uint add;  // 0: the first sample, which also writes hits; 1: adds to the picture
  uint color_by_kind;
  uint atom_count;
  int part_length;  // length of a part of the lists, if these are traversed in parts
  int part;
  uint is_last_part;
};

#endif
