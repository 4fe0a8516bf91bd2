// SPDX-License-Identifier: BSD-3-Clause
// The arithmetic of a kernel variant: single precision first, then double precision for decisions in doubt.
#ifdef DOUBLE_PRECISION
#define real double
#define real2 dvec2
#define real3 dvec3
const double kUnitRoundoff = 1.1102230246251565e-16LF;
#else
#define real float
#define real2 vec2
#define real3 vec3
const float kUnitRoundoff = 5.9604645e-8;
#endif
#define GEOMETRY
#define GEOMETRY_OUT(type) out type
#define GEOMETRY_INOUT(type) inout type

// Types and functions for values that differ from ray to ray. In a kernel they are single values. Where C++ compiles
// the same source, they may be packets of values, defined in core/render/ray_geometry.h and core/render/cpu/packet.h; a
// pixel_row is then a row of adjacent pixels. Values that are the same for all rays have GLSL's own types.
#define truth bool
#define integer int
#define integer2 ivec2
#define pixel_row ivec2
#define natural uint
#define select(condition, yes, no) ((condition) ? (yes) : (no))
#define some(condition) (condition)
