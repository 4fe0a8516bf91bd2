// SPDX-License-Identifier: BSD-3-Clause
// A solid of triangles, cut by one plane and closed again by triangles in that plane.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/mesh_colors.h"
#include "core/render/picture_object.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// A triangle of the mesh, or of a cap.
struct SolidPiece {
  std::array<std::uint32_t, 3> corner{};
  std::uint32_t source = kNone;  ///< of the surface: the triangle that it is a part of
  std::uint32_t plane = kNone;   ///< of a cap
  std::uint32_t atom = kNone;    ///< of a cap
};

/// Inside of closed triangles, whole or cut.
struct Solid {
  std::vector<glm::dvec3> positions, normals;  ///< Å; unit
  std::vector<SolidPiece> pieces;
  std::vector<std::array<std::uint32_t, 2>> sharp_edges;
};

/// What is left of a closed solid below a plane, the caps in the plane included, parted where atoms of two parts are
/// equally near. number: of the plane, for SolidPiece::plane. border_length: Å over which borders of parts may be
/// straight. A plane whose section cannot be triangulated is moved, by less than 1e-5 Å. Throws OpenSurfaceError if
/// that does not help.
Solid cut_solid(const Solid& solid, const ClipPlane& plane, std::uint32_t number, const CapAtoms& atoms,
                double border_length);

}  // namespace meniscus
