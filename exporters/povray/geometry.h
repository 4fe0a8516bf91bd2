// SPDX-License-Identifier: BSD-3-Clause
// The geometry of a scene: each surface as a union of its pieces, and where its copies are.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/color/color_key.h"
#include "core/base/output_file.h"
#include "core/queries/surface_object.h"
#include "exporters/povray/cap_objects.h"
#include "exporters/povray/palette.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {

/// Looks at objects and planes that must outlive it. Pieces of hidden atoms are left out.
class Geometry {
 public:
  /// origin: Å, of the scene's coordinates. table: gets the colours, in the order of their numbers.
  /// clip: of the surface, as the first copy is; only of a single object that is not copied. names: nothing, or of
  /// the atoms that SurfaceObject::atom counts, for a comment on each piece; they must outlive it, too.
  Geometry(std::span<const SurfaceObject> objects, const glm::dvec3& origin, ColorTable& table, ObjectStyle style = {},
           std::span<const ClipPlane> clip = {}, std::span<const std::string> names = {});

  /// Adds caps, made of these objects or of those that they were merged of, and their colours to the table.
  void add_caps(CapMesh mesh, std::span<const SurfaceObject> objects, const SurfaceCut& cut, ColorTable& table);
  /// Writes the caps, of which there may be none.
  void write_caps(OutputFile& file, const SurfaceCut& cut) const;

  /// Primitives written.
  std::size_t primitive_count() const;
  /// Primitives that POV-Ray keeps: its copies of a union share nothing, and a declared union is one more.
  std::size_t primitives_in_memory() const;
  /// True when the text of write() is a single item, which a POV-Ray union does not like to hold.
  bool is_one_item() const;

  /// Pieces or, when anything is copied, moved or divided into objects, `#local object_N = union {...}` for each
  /// object that shows something and then `object { object_N matrix <...> }` for each copy.
  /// head: scene text after the comments at the top.
  void write(OutputFile& file, std::string_view head = {}) const;

  /// Are there names of objects to tell?
  bool declares() const;

  /// {"objects": [{"object": "object_1", "name": ..., "primitives": ..., "copies": ...}], "colors": ...}
  std::string names_json(const std::optional<ColorKey>& colors) const;

 private:
  std::size_t item_count(std::size_t object) const;
  void write_pieces(OutputFile& file, SceneText& out, std::size_t object) const;
  /// What the piece is and whose, if names were given.
  void append_comment(SceneText& out, std::size_t object, const ColoredPiece& piece) const;
  /// The map is sampled beside the surface, so that each patch has its own way to it.
  bool has_own_way(std::size_t object, const ColoredPiece& piece) const;
  void append_offset_textures(SceneText& out, std::size_t object, const ColoredPiece& piece) const;
  void append_copy(SceneText& out, std::size_t object, const RigidMotion& motion) const;

  std::span<const SurfaceObject> objects_;
  glm::dvec3 origin_;
  ObjectStyle style_;
  std::vector<Palette> palettes_;  ///< one an object
  std::span<const ClipPlane> clip_;
  std::span<const std::string> names_;
  Caps caps_;
};

}  // namespace meniscus::povray
