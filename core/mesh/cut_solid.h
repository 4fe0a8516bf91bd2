// SPDX-License-Identifier: BSD-3-Clause
// Cuts a solid of triangles by a plane and closes it again with triangles in that plane.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/mesh_colors.h"
#include "core/render/picture.h"
#include "core/surface/primitives.h"

namespace meniscus {

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
