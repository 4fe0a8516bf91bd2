// SPDX-License-Identifier: BSD-3-Clause
// Fetches the results of points.frag under the names that the shared sources of the look need.
#ifndef MENISCUS_WEBGL_SAMPLE_TEXELS_GLSL
#define MENISCUS_WEBGL_SAMPLE_TEXELS_GLSL
#include "gpu_shaders/webgl/tables.glsl"
#include "gpu_shaders/look/parameters.glsl"

uniform usampler2D normal_texels;
#include "gpu_shaders/look/view_space.glsl"

float depth_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(normal_texels, pixel, 0).w); }

float depth_or_nothing(ivec2 pixel) { return in_block(pixel) ? depth_at(pixel) : kNothing; }

vec3 hit_normal_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(normal_texels, pixel, 0).xyz); }

#endif
