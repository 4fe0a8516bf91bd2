// SPDX-License-Identifier: BSD-3-Clause
// Surfaces with their meshes, atoms, measured numbers and a camera as one .mns file, which the Blender add-on reads.
#pragma once

#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/color/color_key.h"
#include "core/mesh/triangle_mesh.h"
#include "core/queries/surface_object.h"
#include "core/render/picture.h"
#include "exporters/blender/mns_file.h"
#include "exporters/mesh_files/mesh_formats.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus::blender {

/// The default tolerance of a mesh for Blender, Å.
inline constexpr double kTolerance = 0.1;
/// The default tolerance of the frames of a run, Å. Whole molecules look the same, and files have half the size.
inline constexpr double kRunTolerance = 0.2;

/// The origin of a surface, which the file contains and Blender shows as custom properties.
struct Provenance {
  std::string source;              ///< name of the input file without folder
  std::string radii_set;           ///< "bondi" or "file"
  std::string device;              ///< device that computed the surface
  std::optional<ColorKey> colors;  ///< meaning of the colours
};

/// Planes that cut a surface, and the style of their caps.
struct CutFile {
  std::vector<ClipPlane> planes;
  CapStyle style;
};

/// One object and its mesh.
struct MeshedObject {
  const SurfaceObject& object;
  TriangleMesh mesh;  ///< an object whose mesh has no triangles is not written
  AtomAttributes atoms;
  std::vector<glm::dvec3> velocities;         ///< per vertex, Å per scene frame; empty if not written
  bool thickens = false;                      ///< PictureObject::thickens, for colours with opacities
  std::vector<std::uint32_t> cap_plane = {};  ///< per triangle of the caps, which are the last triangles (CappedMesh)
  CutFile cut = {};                           ///< planes that made the caps; empty: the planes of the file
  MaterialRequest material = {};              ///< differences from the default material
  /// A face on which each vertex lies, index into Surface::faces; empty: the face of its first triangle.
  std::vector<std::uint32_t> vertex_face = {};
  std::vector<VertexNumbers> numbers = {};  ///< finite numbers per vertex (add_surface_numbers)
  std::vector<float> patch_area = {};       ///< per triangle, Å²; empty if not written
};

/// The frame of a run that a file contains. The file must state it, because files of several runs may be in one folder.
struct PlaceInRun {
  std::string run;              ///< run_name() of the manifest
  std::uint64_t frame = 0;      ///< frame number of the trajectory
  std::size_t scene_frame = 0;  ///< number of the scene frame, from 1
};

/// Writes the file as FORMAT.md describes. At least one mesh must have triangles. cut: the planes of all objects
/// without planes of their own. on_size: a function that is called with the size of the file in bytes before it is
/// written. Throws OutputError.
void write_objects(const std::string& path, Existing existing, std::span<const MeshedObject> objects,
                   const std::optional<Shot>& shot, const Provenance& provenance,
                   const std::optional<PlaceInRun>& place = {}, const CutFile& cut = {},
                   const std::function<void(std::uint64_t)>& on_size = {});
/// Writes the content without a camera and without a place in a run, into a file that the caller commits.
void write_objects(OutputFile& file, std::span<const MeshedObject> objects, const Provenance& provenance,
                   const CutFile& cut);

/// The requested numbers of a file, in addition to the numbers of atoms that it always has.
struct SurfaceNumbers {
  std::vector<std::string> names;  ///< names of vertex_number_kinds()
  /// True if the user named each number. Numbers that are not available are then an error; otherwise they are left out.
  bool by_name = false;
};

/// The names that "usual" means.
inline constexpr std::string_view kUsualSurfaceNumbers =
    "mean_curvature,gaussian_curvature,atom_area,accessible_area,patch_area";

/// Returns the numbers that a text names, separated by commas as for parse_vertex_numbers(); "usual" means
/// kUsualSurfaceNumbers. Throws RequestError with the word that is no such name.
SurfaceNumbers parse_surface_numbers(std::string_view text);

/// Adds the numbers to an object that has its mesh and its atoms. buried: the buried area of each atom of the structure
/// in Å², or empty. Returns a sentence about numbers that were left out and the reason, or an empty text. If the
/// numbers were named by the user, it throws RequestError for smoothed curvature of a surface that is shown in part,
/// and what atom_areas() throws.
std::string add_surface_numbers(MeshedObject& object, const SurfaceNumbers& requested, std::span<const double> buried);

}  // namespace meniscus::blender
