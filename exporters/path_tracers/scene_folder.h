// SPDX-License-Identifier: BSD-3-Clause
// From surfaces and shapes to a scene in a folder: its text, and beside it a PLY file for each mesh, or one a colour.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/output_file.h"
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

/// Which program a scene is for.
enum class Renderer { mitsuba, pbrt };

/// Where a scene goes. Its name begins those of all files: letters, digits, '-' and '_' only.
struct SceneTarget {
  Renderer renderer = Renderer::mitsuba;
  std::filesystem::path folder;  ///< made when missing
  std::string name = "surface";
  Existing existing = Existing::refuse;
};

/// What was written.
struct SceneReport {
  std::vector<std::filesystem::path> files;               ///< the scene last
  std::size_t triangles = 0, spheres = 0, cylinders = 0;  ///< copies not counted
};

/// <name>.xml or <name>.pbrt, and <name>_1.ply and so on; all or none. Throws RequestError where the scene shows
/// nothing, OutputError.
SceneReport write_scene(const Scene& scene, const SceneTarget& target);

/// In the order in which colours occur; those that are alike in sRGB of 8 bits a channel are one, that which it is
/// there. The colour of a triangle is that of its corners, which is one.
std::vector<SceneMesh> split_colors(const SceneMesh& mesh);

}  // namespace meniscus::path_tracers
