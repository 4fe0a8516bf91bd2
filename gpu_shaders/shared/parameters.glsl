// SPDX-License-Identifier: BSD-3-Clause
// Parameters that the host passes to kernels, as uniform blocks of GLSL and structs of C++, and records that both
// exchange (core/gpu/kernel_records.h says how). The parameters of ray casting and shading, which pages in a browser
// have, too, are in ray_cast/parameters.glsl and look/parameters.glsl.
#ifndef MENISCUS_SHARED_PARAMETERS_GLSL
#define MENISCUS_SHARED_PARAMETERS_GLSL

// Prefix sums.

struct ScanParameters {
  uint count;         // number of words
  uint chunk_length;  // words per invocation or per group
  uint limit;         // greatest value of a sum
};

// Stage 2: neighbours, arcs and fixed probes.

// The uniform grid over atom centres, for all kernels that search for neighbours.
struct CellGrid {
  vec4 low;   // xyz: low corner, Å; w: 1 / cell edge
  vec4 size;  // xyz: number of cells along each axis (whole numbers)
};
const int kCellGridBinding = 1;

struct GridParameters {
  uint atom_count;  // upper bound; the GPU has the exact number
};

struct NeighborParameters {
  uint first_entry;  // first entry of the batch
  uint entry_count;  // upper bound on the number of entries in the batch
  float largest_radius;
  uint capacity;  // capacity of the lists
};

struct PairParameters {
  uint first_entry;  // first entry of the batch
  uint entry_count;  // number of entries in the batch
};

struct CircleParameters {
  double doubt;       // decisions by a smaller relative margin go to the host (decision_doubt())
  uint first_entry;   // first entry of the batch, at which the neighbour lists begin
  uint entry_count;   // number of entries in the batch
  uint circle_count;  // upper bound; the GPU has the exact number
  uint list_limit;    // neighbour lists of this total length had no room
  uint arc_capacity;
  uint doubtful_capacity;
};

struct FixedProbeParameters {
  dvec3 middle;  // middle of the atoms
  double probe_radius;
  uint arc_count;  // upper bound; the GPU has the exact number
  uint probe_capacity;
};

// A fixed probe that a view needs.
struct ProbeRecord {
  dvec3 position;  // Å
  double height;   // height over the plane of its atoms, Å
  uvec4 atoms;     // members of Triple: a < b < c, side
  uint key;        // key of the triple
  uint unused[3];  // fill the record up to a multiple of 32 bytes
};

// Stage 4: singularities.

struct CutParameters {
  uint first_probe;  // first probe of the batch
  uint probe_count;  // number of probes in the batch
  float probe_radius;
};

struct CuspParameters {
  uint first_probe;  // first probe of the batch, at which the neighbour lists begin
  uint circle_count;
  uint arc_capacity;
  uint doubtful_capacity;
};

// One side of a fixed probe's spherical polygon: struct CuspSide of core/surface/cusp_tracer.h in single precision.
struct SideRecord {
  vec4 contact;        // xyz: unit vector from the probe to the side's first contact
  vec4 gap_direction;  // xyz: from the spindle circle's centre to the middle of the covered gap
  vec4 circle_center;  // xyz: relative to the probe
  uint circle;         // number of the spindle circle; kNone if it is not a spindle
  uint partner;        // probe across the gap
  uint touching;       // 1 if the circle is exactly as large as the probe
  uint spare;
};

// An exposed arc of the circle of two probes: struct TracedArc of core/surface/cusp_tracer.h.
struct CuspArcRecord {
  uvec4 names;  // lower probe, higher probe, labels of the begin and of the end
  vec4 begin;   // xyz: unit vector from the circle's centre
  vec4 end;
};

// Stage 1: visible atoms.

struct View {
  vec3 eye;           // relative to the middle of the atoms
  float pixel_scale;  // size of a pixel at distance 1; orthographic: in Å
  vec3 right;
  float margin;  // covers the rounding of every bound, in Å
  vec3 up;
  uint orthographic;
  vec3 forward;
  int block_edge;      // pixels; divides kTileEdge
  ivec2 picture_size;  // pixels
  uint keep_all;       // 1 if the eye may be in the solid, or if the whole surface is requested
};
const int kViewBinding = 2;

struct VisibleAtomsParameters {
  uint atom_count;
  float probe_radius;
};

// Stage 3: the paper's own choice of faces.

struct DrawParameters {
  uint count;  // number of atoms or faces
  float probe_radius;
  uint pass;  // 0 or 1; one program does both passes, so that both compute the same numbers
};

struct FaceTableParameters {
  uint table_size;  // a power of two, at least twice the number of faces
  uint count;       // number of faces that fill it, or of arcs that search it
};

struct FaceParameters {
  uint probe_count;
};

// Stage 4: primitives.

// The camera and the capacities of the tables, for all kernels that make primitives.
struct PrimitiveParameters {
  dvec3 pivot;
  double eye_distance;  // distance from the camera to the pivot
  dvec3 camera_position;
  double probe_radius;
  dvec3 camera_forward;
  float slack;
  uint orthographic;
  uint primitive_capacity;
  uint row_capacity;
};
const int kPrimitiveBinding = 1;

struct ArcParameters {
  uint arc_count;  // upper bound; the GPU has the exact number
};

struct ConcaveParameters {
  uint first_probe;  // first probe of the batch
  uint probe_count;  // upper bound on the number of probes in the batch
};

struct ConvexParameters {
  dvec3 middle;      // middle of the atoms
  uint first_entry;  // first entry of the batch
  uint entry_count;  // upper bound on the number of entries in the batch
  uint atom_count;
};

// Flags by which kernels pass on the atoms whose contact circles clip a convex patch.

// The clips of an atom's patch. The atoms on arcs around it (its partners) are sufficient, unless they leave spurious
// parts; then all neighbours clip (theorem 1.1).
const uint kNotShown = 0u;
const uint kByPartners = 1u;
const uint kInDoubt = 2u;  // the partners clip, too, unless double precision decides otherwise
const uint kByNeighbors = 3u;

// Bit n of the mark of an arc in an atom's list is set if word n of the arc names an atom that clips, and no earlier
// arc does. The first word names the other atom of the arc's circle.
const uint kOnCircle = 1u;

// Kernels of tests.

struct ScaleParameters {
  uint count;
  uint offset;
};

struct LoopParameters {
  uint outer;
  uint inner;
};

struct QueryParameters {
  uint count;
};

#endif
