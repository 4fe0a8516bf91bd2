// SPDX-License-Identifier: BSD-3-Clause
// The geometry of a scene: each surface as a union of its pieces, and where its copies stand.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/color/color_key.h"
#include "core/base/output_file.h"
#include "core/queries/colored_shapes.h"
#include "core/queries/surface_object.h"
#include "exporters/povray/cap_objects.h"
#include "exporters/povray/palette.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {

/// Looks at objects that must outlive it. Pieces of hidden atoms are left out.
class Geometry {
 public:
  /// Throws RequestError when nothing is shown. origin: Å, of the scene's coordinates.
  /// colors: those that come first in colors(), whether they occur or not.
  /// shapes: beside the surface, or nothing; they add their colours.
  /// clip: of the surface, as the first copy stands; only of a single object that is not copied.
  Geometry(std::span<const SurfaceObject> objects, const glm::dvec3& origin, std::span<const glm::vec4> colors = {},
           const ColoredShapes* shapes = nullptr, std::span<const ClipPlane> clip = {});

  /// Adds caps, made of these objects or of those that they were merged of.
  void add_caps(CapMesh mesh, std::span<const SurfaceObject> objects, const SurfaceCut& cut);
  /// Writes the file of the caps, of which there may be none.
  void write_caps(OutputFile& file, const SurfaceCut& cut) const;

  const std::vector<glm::vec4>& colors() const { return table_.colors(); }
  bool is_translucent() const;  ///< some colour is
  /// Primitives written.
  std::size_t primitive_count() const;
  /// Primitives that POV-Ray keeps: its copies of a union share nothing, and a declared union is one more.
  std::size_t primitives_in_memory() const;
  /// True when the text of write() is a single item, which a POV-Ray union does not like to hold.
  bool is_one_item() const;

  /// Pieces or, when anything is copied, moved or divided into objects, `#declare object_N = union {...}` for each
  /// object that shows something and then `object { object_N matrix <...> }` for each copy.
  /// head: scene text behind the comments at the top.
  void write(OutputFile& file, std::string_view head = {}) const;

  bool has_shapes() const { return shapes_ != nullptr; }
  /// Writes the file of the shapes.
  void write_shapes(OutputFile& file);

  /// Are there names of objects to tell?
  bool declares() const;

  /// {"objects": [{"object": "object_1", "name": ..., "primitives": ..., "copies": ...}], "colors": ...}
  std::string names_json(const std::optional<ColorKey>& colors) const;

 private:
  void write_pieces(OutputFile& file, SceneText& out, std::size_t object) const;
  void append_copy(SceneText& out, std::size_t object, const RigidMotion& motion) const;

  std::span<const SurfaceObject> objects_;
  const ColoredShapes* shapes_;  ///< nothing where there are none
  glm::dvec3 origin_;
  ColorTable table_;
  std::vector<Palette> palettes_;  ///< one an object
  std::span<const ClipPlane> clip_;
  Caps caps_;
};

}  // namespace meniscus::povray
