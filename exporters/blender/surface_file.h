// SPDX-License-Identifier: BSD-3-Clause
// Surfaces, their meshes, their atoms and a camera as one .mns file, which the Blender add-on beside this file reads.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/color/color_key.h"
#include "core/mesh/triangle_mesh.h"
#include "core/queries/surface_object.h"
#include "core/render/picture_object.h"
#include "exporters/blender/mns_file.h"
#include "exporters/mesh_files/mesh_file.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus::blender {

/// Of a mesh for Blender, Å, unless another is asked for.
inline constexpr double kTolerance = 0.05;
/// The default tolerance of the frames of a run, Å: pictures of the whole molecule look alike, in files of half the
/// size.
inline constexpr double kRunTolerance = 0.2;

/// Where the surface came from; kept in the file and in Blender as custom properties.
struct Provenance {
  std::string source;              ///< the input file's name, without its folder
  std::string radii_set;           ///< "bondi" or "file"
  std::string device;              ///< what computed the surface
  std::optional<ColorKey> colors;  ///< what the colours mean
};

/// Planes that cut a surface, and how their caps look.
struct CutFile {
  std::vector<ClipPlane> planes;
  CapStyle style;
};

/// One object and its mesh.
struct MeshedObject {
  const SurfaceObject& object;
  TriangleMesh mesh;  ///< without triangles: the object is left out
  AtomAttributes atoms;
  std::vector<glm::dvec3> velocities;         ///< per vertex, Å per scene frame; empty: the file has none
  bool thickens = false;                      ///< PictureObject::thickens, for colours with opacities
  std::vector<std::uint32_t> cap_plane = {};  ///< of the last triangles, which are caps (CappedMesh)
  CutFile cut = {};                           ///< that made them; without planes: that of the file
  MaterialRequest material = {};              ///< what differs from the usual one
  /// Per vertex, into Surface::faces: one that it lies on; empty: that of the first of its triangles.
  std::vector<std::uint32_t> vertex_face = {};
  std::vector<VertexNumbers> numbers = {};  ///< finite, per vertex (add_surface_numbers)
  std::vector<float> patch_area = {};       ///< per triangle, Å²; empty: left out
};

/// Which frame of a run a file is: it must say so, since files of several runs may get into one folder.
struct PlaceInRun {
  std::string run;              ///< run_name() of the manifest
  std::uint64_t frame = 0;      ///< of the trajectory
  std::size_t scene_frame = 0;  ///< from 1
};

/// Writes the file as FORMAT.md describes. At least one mesh has triangles. cut: of all objects that have none of their
/// own. tell: called with the size of the file in bytes before it is written. Throws OutputError.
void write_objects(const std::string& path, Existing existing, std::span<const MeshedObject> objects,
                   const std::optional<Shot>& shot, const Provenance& provenance,
                   const std::optional<PlaceInRun>& place = {}, const CutFile& cut = {},
                   const std::function<void(std::uint64_t)>& tell = {});
/// The same, of one moment and without a camera, into a file that others commit.
void write_objects(OutputFile& file, std::span<const MeshedObject> objects, const Provenance& provenance,
                   const CutFile& cut);

}  // namespace meniscus::blender
