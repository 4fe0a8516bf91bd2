// SPDX-License-Identifier: BSD-3-Clause
// The objects of a scene as planes cut them, and their caps as flat meshes gathered by plane and colour.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/mesh/section_mesh.h"
#include "core/queries/surface_object.h"
#include "exporters/povray/palette.h"
#include "exporters/povray/scene_options.h"

namespace meniscus::povray {

/// Triangles of caps, and their colours.
struct Caps {
  CapMesh mesh;
  std::vector<std::uint32_t> color;  ///< per triangle: number in the scene's colours
};

/// The caps that cut.planes make, as fine as the picture needs them: to a tenth of a pixel, from 0.002 to 0.02 Å.
/// Throws as section_caps() does.
CapMesh make_caps(std::span<const SurfaceObject> objects, const SurfaceCut& cut, const Camera& camera, int width,
                  int height);

/// Adds the colours of caps to the table: opacities are those of the atoms. objects: those that the caps are of.
Caps colored_caps(CapMesh mesh, std::span<const SurfaceObject> objects, const CapStyle& style,
                  const ObjectStyle& object_style, ColorTable& table);

/// Writes mesh2 objects with their textures, hatched as CapStyle says. origin: Å, of the scene's coordinates. Throws
/// Error for a number that is not finite.
void write_caps(OutputFile& file, const Caps& caps, const SurfaceCut& cut, const glm::dvec3& origin);

/// Keeps what it makes; else it only looks at the objects given, which must outlive it.
class CutObjects {
 public:
  /// camera and options: how fine caps have to be. Throws as section_caps() and merged() do.
  CutObjects(std::span<const SurfaceObject> objects, const SurfaceCut& cut, const Camera& camera,
             const SceneOptions& options);
  CutObjects(const CutObjects&) = delete;
  CutObjects& operator=(const CutObjects&) = delete;

  /// All copies as one object where there are planes, for each copy is cut elsewhere, and where they differ.
  std::span<const SurfaceObject> objects() const { return objects_; }
  bool has_caps() const { return cuts_; }
  /// CapMesh::atom: into the atoms of the one object.
  const CapMesh& caps() const { return caps_; }

 private:
  bool cuts_;
  SurfaceObject whole_;
  std::span<const SurfaceObject> objects_;
  CapMesh caps_;
};

}  // namespace meniscus::povray
