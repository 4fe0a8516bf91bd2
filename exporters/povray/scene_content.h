// SPDX-License-Identifier: BSD-3-Clause
// What one picture of a scene shows, ready for its includes: the surface, shapes beside it, and further objects.
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/queries/colored_shapes.h"
#include "core/queries/surface_object.h"
#include "exporters/povray/cap_objects.h"
#include "exporters/povray/geometry.h"
#include "exporters/povray/palette.h"
#include "exporters/povray/scene_files.h"
#include "exporters/povray/scene_options.h"

namespace meniscus::povray {

/// What a picture shows. All must stay until it is written.
struct Shown {
  std::span<const SurfaceObject> surface;  ///< none: it is not shown
  SurfaceCut cut;                          ///< of the surface
  const ColoredShapes* shapes = nullptr;   ///< beside it
  std::span<const SceneObject> objects;    ///< likewise
  std::span<const std::string> names;      ///< of atoms (SceneOptions::atom_names)
  std::optional<bool> film = {};           ///< of the surface; nothing: as SceneOptions::film
};

/// The materials of objects, in the order of SceneColor::finish.
std::vector<MaterialRequest> materials_of(std::span<const SceneObject> objects);

class SceneContent {
 public:
  /// origin: Å, of the scene's coordinates. table: gets the colours behind those that it has. All must outlive it.
  /// Throws as section_caps() and merged() do.
  SceneContent(const Shown& shown, const Camera& camera, const SceneOptions& options, const glm::dvec3& origin,
               ColorTable& table);
  SceneContent(const SceneContent&) = delete;
  SceneContent& operator=(const SceneContent&) = delete;

  /// Of the surface.
  const Geometry& geometry() const { return geometry_; }
  std::span<const SurfaceObject> objects() const { return cut_.objects(); }
  bool has_caps() const { return cut_.has_caps(); }
  bool has_shapes() const { return shown_.shapes && !shown_.shapes->empty(); }
  /// Of the colours that are by one; nullptr: none is.
  const VolumePaint* map() const;
  /// Of further objects.
  std::vector<ObjectPart> parts() const;
  /// Patches, of further objects too.
  std::size_t primitive_count() const;

  /// Makes the file for a part, such as "geometry", "caps", "shapes" or "object_1".
  using BeginFile = std::function<OutputFile&(const std::string& part)>;
  /// Writes those that the scene has an #include for. head: as of Geometry::write.
  void write(const SceneParts& parts, const BeginFile& begin_file, std::string_view head = {}) const;

 private:
  /// A further surface, or shapes.
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

}  // namespace meniscus::povray
