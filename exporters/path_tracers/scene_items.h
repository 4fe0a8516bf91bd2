// SPDX-License-Identifier: BSD-3-Clause
// From surfaces and shapes to things of a scene.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "core/mesh/triangle_mesh.h"
#include "core/queries/colored_shapes.h"
#include "core/queries/surface_object.h"
#include "core/structure/structure.h"
#include "exporters/path_tracers/scene.h"

namespace meniscus::path_tracers {

/// The last triangles of a mesh that planes cut.
struct CapRows {
  std::size_t count = 0;
  std::optional<glm::vec3> color;  ///< sRGB; nothing: those of atoms
};

/// What is shown of a surface: whole spheres, which no other atom touches, as spheres, all else as the mesh has it.
/// mesh: of the shown part, with a row a triangle in its tables. caps: nothing if no plane cuts it. Colours of a volume
/// map are those at vertices.
SceneItem surface_item(const SurfaceObject& object, const TriangleMesh& mesh, const glm::dvec3& origin,
                       const std::optional<CapRows>& caps = {});

/// Shapes beside it; those that are meshes already stay as they are. atoms: the shown atoms (representations.h).
SceneItem shapes_item(std::span<const Atom> atoms, const ColoredShapes& shapes, const glm::dvec3& origin);

}  // namespace meniscus::path_tracers
