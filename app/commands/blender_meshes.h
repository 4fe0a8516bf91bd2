// SPDX-License-Identifier: BSD-3-Clause
// Figures as files for Blender take them, for single scenes, runs and films.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/figure_run.h"
#include "app/options/scene_options.h"
#include "core/mesh/mesh_objects.h"
#include "core/mesh/shape_mesh.h"
#include "core/structure/structure.h"
#include "exporters/blender/surface_file.h"
#include "exporters/blender/surface_numbers.h"

namespace meniscus {

/// All meshes of one figure, and what they refer to.
struct FigureMeshes {
  std::optional<ShapeObject> beside;
  std::vector<ShapeObject> more;
  std::vector<blender::MeshedObject> objects;
};

/// Throws UsageError for what no file for Blender can hold.
void check_blender(const Scene& scene);

/// The camera of a frame, with the picture that the scene makes by it.
blender::Shot blender_shot(const Scene& scene, const Camera& camera);

/// A path without its folder.
std::string file_name(const std::string& path);

/// Where the molecule came from.
blender::Provenance provenance_of(const Molecule& molecule);

/// What cuts the surface.
blender::CutFile cut_file(const SceneCommand& command, const FigureFrame& frame);

/// Meshes the figure. Shapes and objects with looks of their own keep to patches, within fineness.tolerance. frame and
/// made must stay. Throws RequestError where there is nothing, and what meshing throws.
void mesh_figure(const SceneCommand& command, FigureFrame& frame, const blender::CutFile& cut,
                 const MeshFineness& fineness, FigureMeshes& made);

/// Gives all objects the numbers that --attributes asks for. Returns what had to be left out.
std::string add_numbers(const SceneCommand& command, blender::SurfaceNumbers wanted, const Structure& structure,
                        std::vector<blender::MeshedObject>& objects);

}  // namespace meniscus
