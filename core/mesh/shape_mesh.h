// SPDX-License-Identifier: BSD-3-Clause
// Meshes of shapes and of pockets as objects, for exporters that write only meshes.
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

/// Shapes as an object without patches. Its atoms are those of the shapes, with their colours in `object.coloring`. It
/// has one outer component with the measures of the mesh, which consists of closed bodies. The triangles have `atom`,
/// but no kind, face or patch (convex, kNone).
struct ShapeObject {
  SurfaceObject object;
  TriangleMesh mesh;
};

/// Tessellates spheres, and cylinders with their ends, to within `tolerance` (Å); a mesh stays as it is. Vertices lie
/// on the shapes. Cylinders change their atom in the middle, and triangles of a mesh have the atom of their first
/// vertex. `atoms` are the shown atoms (core/scene/representations.h).
ShapeObject shape_object(std::span<const Atom> atoms, const ColoredShapes& shapes, double tolerance);

/// Returns one object with the triangles of both, with one copy each. Triangles of `second` have no valid faces or
/// patches. The patch kinds of the first keep their colours if it is coloured by them.
ShapeObject joined(const SurfaceObject& object, TriangleMesh mesh, const ShapeObject& second);

/// Returns all pockets as one mesh. Normals point out of the pockets, and their volumes are positive. `component` is
/// the place in Pockets::pockets; `atom` has no meaning. `tolerance` is in Å. Throws what tessellate() throws,
/// CapacityError, and RequestError if there are no pockets.
TriangleMesh pocket_mesh(const Pockets& pockets, double tolerance);

}  // namespace meniscus
