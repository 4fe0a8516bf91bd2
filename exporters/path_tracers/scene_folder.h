// SPDX-License-Identifier: BSD-3-Clause
// Turns surfaces and shapes into a scene in a folder: its text, and a PLY file for each mesh or for each colour.
#pragma once

#include "core/base/output_file.h"
#include "core/mesh/triangle_mesh.h"
#include "core/queries/surface_object.h"
#include "core/structure/structure.h"
#include "exporters/path_tracers/path_tracer_scene.h"

namespace meniscus::path_tracers {

/// The caps of a mesh that planes cut, which are its last triangles.
struct CapRows {
  std::size_t count = 0;           ///< number of triangles
  std::optional<glm::vec3> color;  ///< sRGB; empty: the colours of atoms
};

/// Returns the shown part of a surface. Whole spheres, which no other atom touches, become spheres; everything else
/// becomes triangles of `mesh`. mesh: the mesh of the shown part, with one row per triangle in its tables. caps: empty
/// if no plane cuts the surface. Colours of a volume map are those at vertices.
SceneItem surface_item(const SurfaceObject& object, const TriangleMesh& mesh, const glm::dvec3& origin,
                       const std::optional<CapRows>& caps = {});

/// Returns shapes as spheres, cylinders and meshes. Cylinders are split into halves with the colours of their atoms.
/// atoms: the shown atoms (representations.h).
SceneItem shapes_item(std::span<const Atom> atoms, const ColoredShapes& shapes, const glm::dvec3& origin);

/// The program that renders a scene.
enum class Renderer { mitsuba, pbrt };

/// The renderer and the folder of a scene.
struct SceneTarget {
  Renderer renderer = Renderer::mitsuba;
  std::filesystem::path folder;  ///< created if it does not exist
  std::string name = "surface";  ///< begins all file names; letters, digits, '-' and '_' only
  Existing existing = Existing::refuse;
};

/// A report of the written files.
struct SceneReport {
  std::vector<std::filesystem::path> files;               ///< all files, the scene last
  std::size_t triangles = 0, spheres = 0, cylinders = 0;  ///< numbers without copies
};

/// Writes <name>.xml or <name>.pbrt, and <name>_1.ply and so on, all or none. Throws RequestError if the scene shows
/// nothing, and OutputError.
SceneReport write_scene(const PathTracerScene& scene, const SceneTarget& target);

/// Splits a mesh into meshes of one colour, in the order in which colours occur. Colours are rounded to 8 bits per
/// channel of sRGB, and colours that then agree are one. All corners of a triangle must have one colour.
std::vector<SceneMesh> split_colors(const SceneMesh& mesh);

}  // namespace meniscus::path_tracers
