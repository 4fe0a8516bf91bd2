// SPDX-License-Identifier: BSD-3-Clause
// A surface as planes cut it, with its caps, as one mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/queries/surface_object.h"
#include "core/render/picture_object.h"

namespace meniscus::blender {

/// What is shown of the surface, and behind its triangles those of caps: these have atoms, but no face or patch
/// (convex, kNone), and component 0. Along rims vertices are shared; corners of caps are sharp. Closed but where hidden
/// atoms leave holes.
struct CappedMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> cap_plane;  ///< of the last triangles: into the planes
};

/// No planes: the whole surface. Else the object must stand in one place, not moved. one_color: caps have no borders
/// where colours of atoms change. tolerance: Å. Throws as tessellate() and cut_mesh() do.
CappedMesh capped_mesh(const SurfaceObject& object, std::span<const ClipPlane> planes, bool one_color,
                       double tolerance);

}  // namespace meniscus::blender
