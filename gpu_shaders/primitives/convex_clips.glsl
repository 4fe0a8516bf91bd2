// SPDX-License-Identifier: BSD-3-Clause
// Flags by which kernels pass on the atoms whose contact circles clip a convex patch.
#ifndef MENISCUS_CONVEX_CLIPS_GLSL
#define MENISCUS_CONVEX_CLIPS_GLSL

// The clips of an atom's patch. The atoms on arcs around it (its partners) are sufficient, unless they leave spurious
// parts; then all neighbours clip (theorem 1.1).
const uint kNotShown = 0u;
const uint kByPartners = 1u;
const uint kInDoubt = 2u;  // by partners, too, unless double precision decides otherwise
const uint kByNeighbors = 3u;

// Bit n of the mark of an arc in an atom's list is set if word n of the arc names an atom that clips, and no earlier
// arc does. The first word names the other atom of the arc's circle.
const uint kOnCircle = 1u;

#endif
