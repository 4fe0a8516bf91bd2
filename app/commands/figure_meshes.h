// SPDX-License-Identifier: BSD-3-Clause
// Meshes of a figure for Blender, path tracers and viewers, and notes about them.
#pragma once

#include "app/commands/command_run.h"
#include "app/options/scene_options.h"
#include "core/camera/camera.h"
#include "core/mesh/mesh_objects.h"
#include "core/queries/surface_object.h"
#include "core/scene/molecule.h"
#include "core/structure/structure.h"
#include "exporters/blender/surface_file.h"
#include "exporters/path_tracers/path_tracer_scene.h"

namespace meniscus {

/// Returns true if the command line or the scene sets the fineness of a mesh.
bool has_fineness(const SceneOptions& options);

/// The choice whether each copy of an object has triangles of its own.
enum class CopiesOfMesh { own, shared };

/// Returns the approximate number of triangles of some objects.
double expected_triangles(std::span<const SurfaceObject> objects, const MeshFineness& fineness, CopiesOfMesh copies);

/// Prints a warning before a mesh is made, if it is expected to be very large, unless quiet.
void warn_of_many(const SceneCommand& command, double expected_triangles);

/// Returns "within 0.05 Å of the surface", or the other fineness that was requested.
std::string fineness_words(const MeshRequest& request, const MeshFineness& fineness);

/// Throws RequestError if an even mesh would have to end at atoms that --show leaves out, or at planes.
void refuse_even_parts(const MeshFineness& fineness, bool has_hidden_atoms, bool is_cut);

/// Returns the area of each atom that other chains bury, Å²; empty if `names` does not contain "buried_area". A
/// molecule with copies has no such areas: then the name is removed from a list of all names, and refused by
/// RequestError in any other list.
std::vector<double> buried_by_chains(const MoleculeRequest& molecule, const Structure& structure,
                                     std::vector<std::string>& names, bool all);

/// Returns the properties of `meniscus export blender`.
TakenProperties blender_properties();

/// All meshes of one figure, and the data that they refer to.
struct FigureMeshes {
  std::optional<ShapeObject> extras;
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

/// Returns the properties of exports for path tracers.
TakenProperties traced_properties();

/// A figure's scene, and its fineness.
struct TracedFigure {
  path_tracers::PathTracerScene scene;
  double tolerance = 0.0;  ///< Å
};

/// Makes the scene of a frame of the run, or of its one molecule: the surface with caps where planes cut it, and
/// everything drawn in addition. Scenes of a run have one origin, and the fineness that its first camera needs, unless
/// another tolerance is set. Throws like capped_mesh().
TracedFigure traced_figure(const FigureRun& run, FigureFrame frame);

}  // namespace meniscus
