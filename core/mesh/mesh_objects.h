// SPDX-License-Identifier: BSD-3-Clause
// Triangle meshes of surfaces, shapes and pockets for exporters, and the fineness that they are made with.
#pragma once

#include <glm/vec2.hpp>

#include "core/mesh/triangle_mesh.h"
#include "core/pockets/pockets.h"
#include "core/queries/surface_object.h"

namespace meniscus {

struct Camera;

/// The tolerance (pixels) of meshes that are made for a camera: nothing finer can be seen.
inline constexpr double kPixelsOfACamera = 0.5;

/// The distance that a mesh may have from the surface.
struct MeshRequest {
  double tolerance = 0.01;        ///< Å
  double tolerance_pixels = 0.0;  ///< above 0: in pixels of a picture, instead of `tolerance`
};

/// Returns the tolerance in Å: the requested one, or the size of the requested pixels at the nearest ball, in a picture
/// of `size` (pixels).
double tolerance_of(const MeshRequest& request, glm::ivec2 size, const Camera& camera, std::span<const Ball> balls);

/// Meshes the shown part of each object. Throws RequestError if no triangle is shown, unless `may_be_empty`.
std::vector<TriangleMesh> mesh_objects(std::span<const SurfaceObject> objects, double tolerance,
                                       bool may_be_empty = false);

/// The properties that a mesh should have.
struct MeshFineness {
  double tolerance = 0.05;  ///< Å; the smallest one if it depends on the place
  /// The tolerance (Å) at a point, for even meshes; empty if it is the same everywhere.
  std::function<double(const glm::dvec3&)> tolerance_at;
  double density = 0.0;  ///< above 0: vertices per Å² of an even mesh
  bool even = false;     ///< true for nearly equilateral triangles, which may cross the borders of patches
};

/// Returns the fineness for a picture of `size` (pixels). For an even mesh a pixel is measured at each point, for a
/// mesh that follows patches at the nearest of the balls.
MeshFineness fineness_of(const MeshRequest& request, bool even, double density, glm::ivec2 size, const Camera& camera,
                         std::span<const Ball> balls);

/// Returns about how many triangles the mesh of a surface gets, to a factor of two, without making the mesh.
double estimated_triangles(const Surface& surface, const MeshFineness& fineness);

/// Makes a mesh of this fineness. Throws what tessellate() and even_mesh() throw.
FineMesh fine_mesh(const Surface& surface, const MeshFineness& fineness);

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
