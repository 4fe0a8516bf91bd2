// SPDX-License-Identifier: BSD-3-Clause
// Types and functions for values that differ from ray to ray. In a kernel they are single values. Where C++ compiles
// the same source, they may be packets of values, defined in core/render/ray_geometry.h and core/render/cpu/packet.h; a
// pixel_row is then a row of adjacent pixels. Values that are the same for all rays have GLSL's own types.
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
