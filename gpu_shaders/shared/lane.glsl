// SPDX-License-Identifier: BSD-3-Clause
// Words for what differs from ray to ray: one value in a kernel, a packet of them where C++ compiles the same source
// (core/render/cpu/packet.h). Whatever is the same for all rays has GLSL's own types.
#ifndef MENISCUS_SHARED_LANE_GLSL
#define MENISCUS_SHARED_LANE_GLSL

#define truth bool
#define whole int
#define whole2 ivec2
#define natural uint
#define select(condition, yes, no) ((condition) ? (yes) : (no))
#define some(condition) (condition)

#endif
