// SPDX-License-Identifier: BSD-3-Clause
// Parameters that the host passes to the kernels of this stage, as uniform blocks of GLSL and structs of C++
// (core/gpu/kernel_records.h says how).
#ifndef MENISCUS_LOOK_PARAMETERS_GLSL
#define MENISCUS_LOOK_PARAMETERS_GLSL

struct DepthParameters {
  uint has_marks;
};

const int kMostSkyAxes = 128;
const int kMostLampPlaces = 32;
const int kLightPhases = 2;  // a row of pixels reads each second map, the next row the others
const int kLightSteps = 8192;  // heights in a map are whole numbers below this
const float kLightLift = 0.33;  // height in texels above the surface from which light is looked for

// The maps of light_maps.glsl.
struct LightMapParameters {
  // Three rows for each axis of the sky, then for each place on the lamp. They take a point in the camera's axes to
  // columns and lines of texels and to the height, texels.
  vec4 rows[3 * (kMostSkyAxes + kMostLampPlaces)];
  float sky_texel;  // Å
  float lamp_texel;
  int sky_edge;  // texels
  int lamp_edge;
  int sky_axes;
  int lamp_places;
  int first_lamp_texel;
};

struct FinishParameters {
  vec3 key_direction;
  float key_strength;
  vec3 key_color;  // this and the next numbers are those of RayCastParameters
  float key_share;
  vec3 fill_direction;
  float fill_share;
  vec3 fill_color;
  float ambient;
  vec3 sky;
  float roughness;
  vec3 ground;
  float shadow;      // darkness of the shadows from maps
  vec3 air;          // linear colour that the farthest points fade into
  uint keeps_alpha;  // 0: they fade into transparency instead
  vec3 patch_line_color;  // linear
  float patch_lines;      // width of lines around patches, in pixels
  float specular;  // strength of highlights in the shade
  float shininess;
  float ambient_occlusion;
  float outer_lines;  // width of lines around everything, in pixels
  float inner_lines;  // width of lines around what is in front of something else, in pixels
  float part_lines;   // width of lines between parts, in pixels
  float widest_line;
  float step_pixels;  // lines begin at steps of depth of half an Å and this many pixels
  float fade_pixels;  // lines are black at steps of another three Å and this many pixels
  float depth_cue;
  float first_depth;
  float last_depth;
  uint sample_index;
  uint has_marks;
};

struct PresentParameters {
  vec3 background;   // linear
  float per_sample;  // 1 / number of samples
  ivec2 size;
};

#endif
