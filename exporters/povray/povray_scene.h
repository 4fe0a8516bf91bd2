// SPDX-License-Identifier: BSD-3-Clause
// A folder with a POV-Ray 3.7 scene of surfaces: the analytic patches themselves, never triangles.
#pragma once

#include <list>

#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/queries/surface_object.h"
#include "exporters/povray/povray_files.h"
#include "exporters/povray/povray_options.h"
#include "exporters/povray/scene_shapes.h"
#include "exporters/povray/scene_text.h"
#include "exporters/povray/surface_pieces.h"

namespace meniscus::povray {

/// The things that a picture shows. All of them must live until the picture is written.
struct Shown {
  std::span<const SurfaceObject> surface;  ///< the objects of the surface; empty if it is not shown
  SurfaceCut cut;                          ///< planes that cut the surface
  const ColoredShapes* shapes = nullptr;   ///< shapes in addition to the surface; may be nullptr
  std::span<const SceneObject> objects;    ///< further objects in addition to the surface
  std::span<const std::string> names;      ///< names of atoms (SceneOptions::atom_names)
  std::optional<bool> film = {};           ///< SceneOptions::film for the surface; empty: that of the options
};

/// Returns the materials of objects, in the order of SceneColor::finish.
std::vector<MaterialRequest> materials_of(std::span<const SceneObject> objects);

/// The geometry of everything that one picture shows. It refers to the arguments of its constructor, which must outlive
/// it.
class SceneContent {
 public:
  /// Adds all colours to `table`, after those that it has. origin: the origin of the scene's coordinates, in Å. Throws
  /// what section_caps() and merged() throw.
  SceneContent(const Shown& shown, const Camera& camera, const SceneOptions& options, const glm::dvec3& origin,
               ColorTable& table);
  SceneContent(const SceneContent&) = delete;
  SceneContent& operator=(const SceneContent&) = delete;

  /// Returns the geometry of the surface.
  const Geometry& geometry() const { return geometry_; }
  std::span<const SurfaceObject> objects() const { return cut_.objects(); }
  bool has_caps() const { return cut_.has_caps(); }
  bool has_shapes() const { return shown_.shapes && !shown_.shapes->empty(); }
  /// Returns the volume map that colours points, or nullptr if there is none.
  const VolumePaint* map() const;
  /// Returns a description of each further object, in order.
  std::vector<ObjectPart> parts() const;
  /// Returns the number of primitives of the surface and of all further objects.
  std::size_t primitive_count() const;

  /// A function that creates the file for a part, such as "geometry", "caps", "shapes" or "object_1".
  using BeginFile = std::function<OutputFile&(const std::string& part)>;
  /// Writes the files that the main file includes according to `parts`. head: passed to Geometry::write() of the
  /// surface.
  void write(const SceneParts& parts, const BeginFile& begin_file, std::string_view head = {}) const;

 private:
  /// A further object, which is a surface or shapes.
  struct Further {
    const SceneObject* object = nullptr;
    ObjectStyle style;
    std::optional<CutObjects> cut;
    std::optional<Geometry> geometry;
  };
  void add(const SceneObject& object, const Camera& camera, const SceneOptions& options);

  Shown shown_;
  glm::dvec3 origin_;
  ColorTable& table_;
  CutObjects cut_;
  Geometry geometry_;
  std::list<Further> further_;
  std::uint32_t finishes_ = 0;
};

/// Writes <name>.ini, <name>.pov, <name>.inc, <name>_style.inc, <name>_aov.inc, <name>_geometry.inc,
/// <name>_objects.json and, if there are shapes, caps, more objects or a volume map, <name>_shapes.inc,
/// <name>_caps.inc, <name>_object_1.inc, ... and <name>_map.df3 into `folder`, all or none. given: the objects of the
/// surface; empty if the surface is not shown. One unit is 1 Å; coordinates are relative to options.origin. The camera
/// shows the same pixels as that of the ray caster. Each object with its copies is a union object_1, object_2, ...;
/// their names in the molecule are in the .json only. A surface that planes cut is a single object. Points of hidden
/// atoms are left out. Throws OutputError if a file exists or is not writable, and Error if nothing is shown, a name or
/// size is invalid, or a number is not finite.
SceneReport write_scene(std::span<const SurfaceObject> given, const Camera& camera, const SceneOptions& options,
                        const std::filesystem::path& folder);

}  // namespace meniscus::povray
