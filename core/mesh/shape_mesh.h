// SPDX-License-Identifier: BSD-3-Clause
// Shapes beside a surface, and pockets, as objects with meshes, for exporters that write only meshes.
#pragma once

#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/pockets/pockets.h"
#include "core/queries/surface_object.h"

namespace meniscus {

struct Atom;
struct ColoredShapes;
struct TriangleMesh;

/// An object without patches: its atoms are those that shapes have, their colours in `object.coloring`; one outer
/// component with the measures of the mesh, which consists of closed bodies. Triangles have `atom`; kind, face and
/// patch say nothing (convex, kNone).
struct ShapeObject {
  SurfaceObject object;
  TriangleMesh mesh;
};

/// Tessellates spheres and cylinders, these with ends, no farther than `tolerance` (Å) from what they are; a mesh stays
/// as it is. Cylinders change their atom in the middle, triangles of a mesh have the atom of their first vertex.
/// Vertices lie on the shapes. atoms: the shown atoms (core/scene/representations.h).
ShapeObject shape_object(std::span<const Atom> atoms, const ColoredShapes& shapes, double tolerance);

/// One object of both, with one copy each. In `second` indices of faces and patches say nothing.
/// The kinds of the first keep their colours if it is coloured by them.
ShapeObject joined(const SurfaceObject& object, TriangleMesh mesh, const ShapeObject& second);

/// All of them in one mesh. Normals point out of the pockets, whose volumes are positive; `component` is the place in
/// Pockets::pockets, `atom` says nothing. tolerance: Å. Throws what tessellate throws, CapacityError, RequestError if
/// there are no pockets.
TriangleMesh pocket_mesh(const Pockets& pockets, double tolerance);

}  // namespace meniscus
