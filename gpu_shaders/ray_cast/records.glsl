// SPDX-License-Identifier: BSD-3-Clause
// Data that the host and the ray caster exchange: a bound for each primitive, rows of four floats, and hits.
//
// This file is written in the common subset of GLSL and C++; in C++ the includer provides vec3, vec4 and uint. All
// positions are relative to the pivot, a point in the middle of the picture and near the shown objects, so that single
// precision keeps its digits there. Offsets of planes are relative to the centre of the primitive.
//
// Rows of a convex patch:    centre, radius | plane_count x (normal, offset)
// Rows of a toroidal patch:  centre, R | start, cos sweep | axis, sin sweep | z_low, z_high, clip z, clip radius |
//                            z of atom 0, its extended radius, z of atom 1, its extended radius
// Rows of a concave patch:   centre, p | plane_count x (normal, offset) | contact_count x (direction, atom as bits)
// Rows of a cylinder:        middle, radius | axis, half its length
// Rows of a triangle:        corner a, - | b - a, - | c - a, - | normals at a, b, c, their atoms as bits

struct Primitive {
  vec4 bound;         // sphere around the patch: centre, radius
  float nearest;      // no point of the bound is closer to the camera (orthographic: to its plane), in Å
  uint first_row;
  uint plane_count;   // toroidal: range of patch_membership.glsl
  uint kind;          // PatchKind
  uint patch_index;   // index into the table of its kind
  uint atom;          // convex: the atom; toroidal, cylinder: the first; concave: contact_count
  uint second_atom;   // toroidal; cylinder: the one that the axis points to
  uint tie_key;       // key (triple.glsl) that decides which of two patches a ray shows where it meets both
};

// The hit of the ray through a pixel's centre.
struct Hit {
  vec3 normal;     // towards the solvent
  float t;         // distance from the ray's point on the plane through the pivot, in Å
  uint primitive;  // kNoPrimitive: nothing is hit
  uint atom;
  uint object;     // number of the object, in pictures of several
  uint unused;     // fills the record
};

const uint kConvex = 0u;
const uint kToroidal = 1u;
const uint kConcave = 2u;
const uint kCylinder = 3u;  // this one and the next are not patches, but sticks and ribbons
const uint kTriangle = 4u;
const uint kNoPrimitive = 0xffffffffu;
const uint kOnPlane = 0xfffffffeu;  // primitive of a hit where a plane cuts a solid
