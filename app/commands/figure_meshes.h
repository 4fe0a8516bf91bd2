// SPDX-License-Identifier: BSD-3-Clause
// Figures in the form of files for Blender, for single scenes, runs and films.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/command_run.h"
#include "app/options/scene_options.h"
#include "core/mesh/mesh_objects.h"
#include "core/mesh/shape_mesh.h"
#include "core/structure/structure.h"
#include "exporters/blender/surface_file.h"
#include "exporters/blender/surface_numbers.h"

namespace meniscus {

/// Returns the properties of `meniscus export blender`.
TakenProperties blender_properties();

/// All meshes of one figure, and the data that they refer to.
struct FigureMeshes {
  std::optional<ShapeObject> beside;
  std::vector<ShapeObject> more;
  std::vector<blender::MeshedObject> objects;
};

/// Throws UsageError for settings that no file for Blender can hold.
void check_blender(const Scene& scene);

/// Returns the camera of a frame, with the picture that the scene makes from it.
blender::Shot blender_shot(const Scene& scene, const Camera& camera);

/// Returns a path without its folder.
std::string file_name(const std::string& path);

/// Returns the source of the molecule.
blender::Provenance provenance_of(const Molecule& molecule);

/// Returns the planes that cut the surface.
blender::CutFile cut_file(const SceneCommand& command, const FigureFrame& frame);

/// Meshes the figure. Shapes and objects with materials of their own follow the patches, within fineness.tolerance.
/// frame and made must stay valid. Throws RequestError if there is nothing to mesh, and the errors of meshing.
void mesh_figure(const SceneCommand& command, FigureFrame& frame, const blender::CutFile& cut,
                 const MeshFineness& fineness, FigureMeshes& made);

/// Gives all objects the numbers that --attributes requests. Returns the names of numbers that had to be left out.
std::string add_numbers(const SceneCommand& command, blender::SurfaceNumbers wanted, const Structure& structure,
                        std::vector<blender::MeshedObject>& objects);

}  // namespace meniscus
