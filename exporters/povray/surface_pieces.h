// SPDX-License-Identifier: BSD-3-Clause
// The geometry of a scene: each surface as a union of its pieces, and the places of its copies.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/output_file.h"
#include "core/color/color_key.h"
#include "core/queries/surface_object.h"
#include "exporters/povray/scene_colors.h"
#include "exporters/povray/scene_shapes.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {

/// The geometry of a scene: objects with their pieces, and caps. It refers to objects and planes, which must outlive
/// it. Pieces of hidden atoms are left out.
class Geometry {
 public:
  /// Adds the colours of all pieces to `table`. origin: the origin of the scene's coordinates, in Å. clip: the planes
  /// that cut the surface; they are allowed only for a single object that is neither copied nor moved, and Error is
  /// thrown otherwise. names: empty, or the names of the atoms that SurfaceObject::atom refers to, for a comment on
  /// each piece; they must outlive this object.
  Geometry(std::span<const SurfaceObject> objects, const glm::dvec3& origin, ColorTable& table, ObjectStyle style = {},
           std::span<const ClipPlane> clip = {}, std::span<const std::string> names = {});

  /// Adds caps to the geometry, and their colours to the table. objects: the objects that were cut.
  void add_caps(CapMesh mesh, std::span<const SurfaceObject> objects, const SurfaceCut& cut, ColorTable& table);
  /// Writes the caps, if there are any.
  void write_caps(OutputFile& file, const SurfaceCut& cut) const;

  /// Returns the number of primitives that write() writes.
  std::size_t primitive_count() const;
  /// Returns the number of primitives that POV-Ray keeps in memory: copies of a union share nothing there, and a
  /// declared union counts once more.
  std::size_t primitives_in_memory() const;
  /// True if the text of write() is a single item. POV-Ray warns about a union of a single item.
  bool is_one_item() const;

  /// Writes the pieces. If declares_objects() is true, it writes `#local object_N = union {...}` for each object that
  /// shows something and then `object { object_N matrix <...> }` for each copy. head: scene text after the comments at
  /// the top.
  void write(OutputFile& file, std::string_view head = {}) const;

  /// True if objects are declared under names: there are several, or one is copied or moved.
  bool declares_objects() const;

  /// Returns the JSON text that maps object names of the scene to names of the molecule:
  /// {"objects": [{"object": "object_1", "name": ..., "primitives": ..., "copies": ...}], "colors": ...}
  std::string names_json(const std::optional<ColorKey>& colors) const;

 private:
  std::size_t item_count(std::size_t object) const;
  void write_pieces(OutputFile& file, SceneText& out, std::size_t object) const;
  /// Appends a comment with the kind and the atoms of a piece, if names were given.
  void append_comment(SceneText& out, std::size_t object, const ColoredPiece& piece) const;
  /// True if the volume map is sampled at an offset from the surface. Each patch then has a texture of its own that
  /// moves its points to where the map is sampled.
  bool has_offset_textures(std::size_t object, const ColoredPiece& piece) const;
  void append_offset_textures(SceneText& out, std::size_t object, const ColoredPiece& piece) const;
  void append_copy(SceneText& out, std::size_t object, const RigidMotion& motion) const;

  std::span<const SurfaceObject> objects_;
  glm::dvec3 origin_;
  ObjectStyle style_;
  std::vector<Palette> palettes_;  ///< one per object
  std::span<const ClipPlane> clip_;
  std::span<const std::string> names_;
  Caps caps_;
};

}  // namespace meniscus::povray
