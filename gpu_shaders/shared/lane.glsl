// SPDX-License-Identifier: BSD-3-Clause
// Types and functions for values that differ from ray to ray: in a kernel, single values. Where C++ compiles the same
// source they may be packets of values, and are types and functions there (core/render/ray_geometry.h,
// core/render/cpu/packet.h); of a pixel_row there are as many, side by side. Whatever is the same for all rays has GLSL's own types.
#if !defined(MENISCUS_SHARED_LANE_GLSL) && !defined(__cplusplus)
#define MENISCUS_SHARED_LANE_GLSL

#define truth bool
#define integer int
#define integer2 ivec2
#define pixel_row ivec2
#define natural uint
#define select(condition, yes, no) ((condition) ? (yes) : (no))
#define some(condition) (condition)

#endif
