// SPDX-License-Identifier: BSD-3-Clause
// Numbers that kernels and the host share, for GLSL and C++ (core/gpu/kernel_records.h).
#ifndef MENISCUS_SHARED_CONSTANTS_GLSL
#define MENISCUS_SHARED_CONSTANTS_GLSL

const uint kNone = 0xffffffffu;      // no atom, probe, circle or face
const uint kAxisLabel = 0x80000000u;  // marks the label of a cusp arc's end: a side whose spindle axis ends the arc
const int kTileEdge = 16;            // pixels; pictures are made in tiles
const float kNothing = 3.0e38;       // depth where nothing is met, Å

#endif
