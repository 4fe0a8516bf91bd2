// SPDX-License-Identifier: BSD-3-Clause
// The solid of a closed mesh cut by planes: what is left of its surface, the caps that close it again, and both as one
// mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/mesh_colors.h"
#include "core/mesh/triangle_mesh.h"
#include "core/queries/surface_object.h"
#include "core/render/picture_object.h"

namespace meniscus {

struct SurfaceObject;

/// Plain arrays of flat triangles.
struct CapMesh {
  std::vector<glm::dvec3> positions;  ///< Å
  std::vector<std::uint32_t> rim;     ///< per position: the vertex of CutMesh::surface at this place, or kNone
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from where the solid was cut away
  std::vector<std::uint32_t> plane;                     ///< per triangle: into the planes; their normals are the caps'
  std::vector<std::uint32_t> atom;                      ///< per triangle: of CapAtoms, whose colour is shown
};

/// A solid that planes cut. Surface and caps together are closed as the mesh was: their rims are the same vertices.
struct CutMesh {
  TriangleMesh surface;  ///< of what is left; partly_hidden where anything was cut away
  CapMesh caps;
};

/// Cuts a closed mesh by all planes, each of which cuts the caps of those before. Rims are where the mesh crosses the
/// plane: its distance from the surface is the mesh's tolerance divided by the sine between surface and plane. Borders
/// of parts are straight over lengths on which an arc of radius 1 Å is flat to the tolerance; a part that is narrower
/// may be lost. A plane that meets the mesh in such a way that its section cannot be triangulated is moved, by less
/// than 1e-5 Å. Throws OpenSurfaceError if that does not help.
CutMesh cut_mesh(TriangleMesh mesh, std::span<const ClipPlane> planes, const CapAtoms& atoms);

/// The caps of all copies of all objects, of meshes of this tolerance (Å). CapMesh::atom: into placed_balls(objects);
/// CapMesh::rim is empty. Triangles of hidden atoms are left out. Where solids of copies overlap, so do their caps,
/// which have the same colours there. Throws as tessellate() and cut_mesh() do.
CapMesh section_caps(std::span<const SurfaceObject> objects, std::span<const ClipPlane> planes, bool one_color,
                     double tolerance);

/// What is shown of the surface, and behind its triangles those of caps: these have atoms, but no face or patch
/// (convex, kNone), and component 0. Along rims vertices are shared; corners of caps are sharp. Closed but where hidden
/// atoms leave holes.
struct CappedMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> cap_plane;  ///< of the last triangles: into the planes
};

/// No planes: the whole surface. Else the object must be in one place, not moved. one_color: caps have no borders
/// where colours of atoms change. tolerance: Å. Throws as tessellate() and cut_mesh() do.
CappedMesh capped_mesh(const SurfaceObject& object, std::span<const ClipPlane> planes, bool one_color,
                       double tolerance);

}  // namespace meniscus
