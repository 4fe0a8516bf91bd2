// SPDX-License-Identifier: BSD-3-Clause
// Cuts the solid of a closed mesh by planes: the rest of its surface, the caps that close it, and both as one mesh.
#pragma once

#include "core/mesh/mesh_colors.h"
#include "core/mesh/triangle_mesh.h"
#include "core/queries/surface_object.h"
#include "core/render/picture.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Caps as plain arrays of flat triangles.
struct CapMesh {
  std::vector<glm::dvec3> positions;  ///< Å
  std::vector<std::uint32_t> rim;     ///< per position: the vertex of CutMesh::surface at this place, or kNone
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from where the solid was cut away
  /// Per triangle: the number of its plane, from 0; the cap lies in the plane and has its normal.
  std::vector<std::uint32_t> plane;
  /// Per triangle: the atom that gives it its colour, an index into the atoms of CapAtoms.
  std::vector<std::uint32_t> atom;
};

/// A solid cut by planes. Surface and caps together are closed if the mesh was; their rims have the same vertices.
struct CutMesh {
  TriangleMesh surface;  ///< the rest of the surface; its member partly_hidden is true if anything was cut away
  CapMesh caps;
};

/// Cuts a closed mesh by all planes, each of which also cuts the caps of those before it. The side with dot(normal, x)
/// >= offset is removed. `atoms` (CapAtoms) gives each point of a cap its nearest atom. An open mesh may fail at any
/// plane. Rims lie where the mesh crosses the plane. Their distance from the surface is the mesh's tolerance divided by
/// the sine of the angle between surface and plane. Borders on caps between atoms of different parts are straight over
/// sqrt(8 tolerance) Å, a length over which an arc of radius 1 Å is flat to within the tolerance. A narrower part may
/// be lost. A plane whose section cannot be triangulated is moved by less than 1e-5 Å. Throws OpenSurfaceError if it
/// still cannot.
CutMesh cut_mesh(TriangleMesh mesh, std::span<const ClipPlane> planes, const CapAtoms& atoms);

/// Returns the caps of all copies of all objects, from meshes of this tolerance (Å); without planes or objects, no
/// caps. CapMesh::atom is an index into placed_balls(objects), the balls of all copies in order; CapMesh::rim is empty.
/// `one_color` is as in capped_mesh(). Triangles of hidden atoms are left out. Where solids of copies overlap, so do
/// their caps, which have the same colours there. Throws what tessellate() and cut_mesh() throw.
CapMesh section_caps(std::span<const SurfaceObject> objects, std::span<const ClipPlane> planes, bool one_color,
                     double tolerance);

/// The shown triangles of a surface, followed by the triangles of its caps. A triangle of a cap has an atom; its
/// component is 0, its face and patch are kNone, and its kind is PatchKind::convex. Surface and caps share the vertices
/// along rims; the corners of caps are sharp. The mesh is closed except for holes that hidden atoms leave.
struct CappedMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> cap_plane;  ///< per cap triangle, the last ones of the mesh: its plane
};

/// Returns the mesh of an object cut by planes, or of its whole surface if there are none. Copies are ignored: the mesh
/// is that of the object where it was computed, so with planes it should have a single copy that is not moved. With
/// `one_color`, caps have no borders where colours of atoms change. `tolerance` is in Å. Throws what tessellate() and
/// cut_mesh() throw.
CappedMesh capped_mesh(const SurfaceObject& object, std::span<const ClipPlane> planes, bool one_color,
                       double tolerance);

/// A triangle of the mesh or of a cap.
struct SolidPiece {
  std::array<std::uint32_t, 3> corner{};
  std::uint32_t source = kNone;  ///< the triangle of the surface that this is a part of; kNone on a cap
  std::uint32_t plane = kNone;   ///< the plane of a cap; kNone elsewhere
  std::uint32_t atom = kNone;    ///< the atom of a cap; kNone elsewhere
};

/// The solid inside closed triangles, whole or cut.
struct Solid {
  std::vector<glm::dvec3> positions, normals;  ///< positions in Å; unit normals
  std::vector<SolidPiece> pieces;
  std::vector<std::array<std::uint32_t, 2>> sharp_edges;
};

/// Returns the part of a closed solid below a plane, with the caps in the plane. Caps are divided where atoms of two
/// parts are equally near. `number` becomes SolidPiece::plane of the caps. `border_length` is the length (Å) over which
/// borders of parts may be straight. A plane with a section that cannot be triangulated is moved by less than 1e-5 Å.
/// Throws OpenSurfaceError if that does not help.
Solid cut_solid(const Solid& solid, const ClipPlane& plane, std::uint32_t number, const CapAtoms& atoms,
                double border_length);

}  // namespace meniscus
