// SPDX-License-Identifier: BSD-3-Clause
// Writes a scene into a folder: its text, and beside it a PLY file for each mesh, or one a colour.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/output_file.h"
#include "exporters/path_tracers/scene.h"

namespace meniscus::path_tracers {

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

/// Positions, normals and, where asked for, colours as floats r, g, b, which Mitsuba reads as "vertex_color".
void write_mesh(OutputFile& file, const SceneMesh& mesh, bool with_colors);

/// In the order in which colours occur; those that are alike in sRGB of 8 bits a channel are one, that which it is
/// there. The colour of a triangle is that of its corners, which is one.
std::vector<SceneMesh> split_colors(const SceneMesh& mesh);

}  // namespace meniscus::path_tracers
