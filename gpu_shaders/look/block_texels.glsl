// SPDX-License-Identifier: BSD-3-Clause
// Fetches values of a cast block for the kernels of this stage, under the names that view_space.glsl needs.
#ifndef MENISCUS_LOOK_BLOCK_TEXELS_GLSL
#define MENISCUS_LOOK_BLOCK_TEXELS_GLSL
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/ray_cast/parameters.glsl"

layout(binding = 0) uniform usamplerBuffer hit_texels;  // two texels each: struct Hit of ray_cast/records.glsl
layout(binding = 1) uniform usamplerBuffer depth_texels;

layout(std140, binding = kBlockViewBinding) uniform ViewBlock { BlockView view; };

int index_of(ivec2 pixel) { return pixel.y * view.size.x + pixel.x; }

#include "gpu_shaders/look/view_space.glsl"

// Returns the depth of a pixel along the view axis in Å, or kNothing.
float depth_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(depth_texels, index_of(pixel)).x); }

float depth_or_nothing(ivec2 pixel) { return in_block(pixel) ? depth_at(pixel) : kNothing; }

vec3 hit_normal_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(hit_texels, 2 * index_of(pixel)).xyz); }

#endif
