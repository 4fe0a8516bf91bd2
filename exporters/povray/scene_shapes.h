// SPDX-License-Identifier: BSD-3-Clause
// Caps of cut surfaces as flat meshes, and spheres, cylinders and meshes drawn in addition to surfaces.
#pragma once

#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/mesh/section_mesh.h"
#include "core/queries/surface_object.h"
#include "exporters/povray/povray_options.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {

/// The triangles of caps and their colours.
struct Caps {
  CapMesh mesh;
  std::vector<std::uint32_t> color;  ///< per triangle: index into the colours of the scene
};

/// Returns the caps with their colours, which are added to the table. Opacities are those of the atoms. objects: the
/// objects that were cut.
Caps colored_caps(CapMesh mesh, std::span<const SurfaceObject> objects, const CapStyle& style,
                  const ObjectStyle& object_style, ColorTable& table);

/// Writes caps as mesh2 objects with textures, hatched according to cut.style. origin: the origin of the scene's
/// coordinates, in Å. Throws Error for a number that is not finite.
void write_caps(OutputFile& file, const Caps& caps, const SurfaceCut& cut, const glm::dvec3& origin);

/// The objects of a scene after they were cut by planes, and their caps. It owns the merged object and the caps. It
/// refers to the given objects, which must outlive it.
class CutObjects {
 public:
  /// camera and options determine the tolerance of the caps (make_caps()). Throws what section_caps() and merged()
  /// throw.
  CutObjects(std::span<const SurfaceObject> objects, const SurfaceCut& cut, const Camera& camera,
             const SceneOptions& options);
  CutObjects(const CutObjects&) = delete;
  CutObjects& operator=(const CutObjects&) = delete;

  /// Returns one object with all copies merged if there are planes, because each copy is cut in another place, or if
  /// copies differ (copies_differ()). Returns the given objects otherwise.
  std::span<const SurfaceObject> objects() const { return objects_; }
  bool has_caps() const { return cuts_; }
  /// Returns the caps, of which CapMesh::atom is an index into the atoms of the merged object.
  const CapMesh& caps() const { return caps_; }

 private:
  bool cuts_;
  SurfaceObject whole_;
  std::span<const SurfaceObject> objects_;
  CapMesh caps_;
};

/// Writes shapes as sphere, cylinder and mesh2 objects with textures. A cylinder of two colours becomes two halves. The
/// text consists of names chosen by this program and of numbers only. origin: the origin of the scene's coordinates, in
/// Å. Colours that `table` does not have yet are added. Throws Error for a number that is not finite.
void write_shapes(OutputFile& file, const ColoredShapes& shapes, const glm::dvec3& origin, ColorTable& table,
                  const ObjectStyle& style = {});

/// Adds the colours of all shapes to the table.
void add_colors(const ColoredShapes& shapes, ColorTable& table, const ObjectStyle& style = {});

}  // namespace meniscus::povray
