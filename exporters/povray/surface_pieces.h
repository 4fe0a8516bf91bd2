// SPDX-License-Identifier: BSD-3-Clause
// The geometry of a scene: each surface as a union of its pieces, every patch as one primitive cut out by clipped_by,
// the places of copies, and checks of scenes before and after they are written; with caps of cut surfaces as flat
// meshes, and spheres, cylinders and meshes drawn in addition to surfaces.
#pragma once

#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/color/color_key.h"
#include "core/math/box.h"
#include "core/mesh/section_mesh.h"
#include "core/queries/surface_object.h"
#include "core/render/picture.h"
#include "core/surface/primitives.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {

/// The triangles of caps and their colours.
struct Caps {
  CapMesh mesh;
  std::vector<std::uint32_t> color;  ///< per triangle: index into the colours of the scene
};

/// Returns caps with their colours, added to the table, and the atoms' opacities. objects: those that were cut.
Caps colored_caps(CapMesh mesh, std::span<const SurfaceObject> objects, const CapStyle& style,
                  const ObjectStyle& object_style, ColorTable& table);

/// Writes caps as mesh2 objects with textures, hatched according to cut.style. origin: the origin of the scene's
/// coordinates, in Å. Throws Error for a number that is not finite.
void write_caps(OutputFile& file, const Caps& caps, const SurfaceCut& cut, const glm::dvec3& origin);

/// The objects of a scene after they were cut by planes, and their caps. It owns the merged object and the caps. It
/// refers to the given objects, which must outlive it.
class CutObjects {
 public:
  /// camera, options: they determine the tolerance of caps. Throws the errors of section_caps() and merged().
  CutObjects(std::span<const SurfaceObject> objects, const SurfaceCut& cut, const Camera& camera,
             const SceneOptions& options);
  CutObjects(const CutObjects&) = delete;
  CutObjects& operator=(const CutObjects&) = delete;

  /// Returns one object with all copies merged if there are planes, because each copy is cut in another place, or if
  /// copies differ (copies_differ()). Returns the given objects otherwise.
  std::span<const SurfaceObject> objects() const { return objects_; }
  bool has_caps() const { return cuts_; }
  /// Returns the caps. Their CapMesh::atom is an index into the atoms of the merged object.
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
  /// Returns true if the text of write() is a single item. POV-Ray warns about a union of a single item.
  bool is_one_item() const;

  /// Writes the pieces. If declares_objects() is true, it writes `#local object_N = union {...}` for each object that
  /// shows something and then `object { object_N matrix <...> }` for each copy. head: scene text after the comments at
  /// the top.
  void write(OutputFile& file, std::string_view head = {}) const;

  /// Returns true if objects are declared under names: there are several, or one is copied or moved.
  bool declares_objects() const;

  /// Returns the JSON text that maps object names of the scene to names of the molecule:
  /// {"objects": [{"object": "object_1", "name": ..., "primitives": ..., "copies": ...}], "colors": ...}
  std::string names_json(const std::optional<ColorKey>& colors) const;

 private:
  std::size_t item_count(std::size_t object) const;
  void write_pieces(OutputFile& file, SceneText& out, std::size_t object) const;
  /// Appends a comment with the kind and the atoms of a piece, if names were given.
  void append_comment(SceneText& out, std::size_t object, const ColoredPiece& piece) const;
  /// Returns true if the volume map is sampled at an offset from the surface. Each patch then has its own texture,
  /// which moves its points to where the map is sampled.
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

/// Writes patches relative to `origin` (Å) as primitives cut by clips. The part inside all clips is exactly the patch
/// (theorem 1 of docs/explanation/theory.md):
///  convex    sphere within its planes;
///  toroidal  torus within the visibility sphere (through both contact circles, centred on the axis; it keeps the side
///            that faces the axis) and the wedge of the arc. A spindle is a torus that crosses its axis in two points;
///            it is also outside of the lemon, the ball with these as poles;
///  concave   sphere of the probe within its side planes and the bisectors towards other probes.
/// The clips of toroidal and concave patches end with the patch's exact box, which POV-Ray needs for its bounding
/// hierarchy only.
class PatchObjects {
 public:
  /// clip: planes that cut the whole surface; patches that a plane intersects are clipped by it as well. Keeps
  /// references to the surface, the palette and the planes, which must outlive this object.
  PatchObjects(const Surface& surface, const Palette& palette, const glm::dvec3& origin,
               std::span<const ClipPlane> clip = {})
      : surface_(surface), palette_(palette), origin_(origin), clip_(clip) {}

  /// Returns true if the planes cut away the whole patch.
  bool is_cut_away(const ColoredPiece& piece) const;

  /// Appends one line with the primitive of the piece, which is the part of a patch with one colour and visibility. The
  /// line also cuts away the other pieces of the patch. The piece must not be one that is_cut_away(), or its primitive
  /// would be empty.
  void append(SceneText& out, const ColoredPiece& piece) const;

 private:
  void convex(SceneText& out, const ConvexPatch& patch, std::string_view cuts) const;
  void toroidal(SceneText& out, const ToroidalPatch& patch, std::uint32_t part, std::string_view cuts) const;
  void concave(SceneText& out, const ConcavePatch& patch, std::uint32_t part, std::string_view cuts) const;
  void visibility_sphere(SceneText& out, const ToroidalPatch& patch) const;
  void wedge(SceneText& out, const ToroidalPatch& patch) const;
  /// Appends the half-space of points nearer to the atom of this part; nothing if both atoms are of the part.
  void part_half(SceneText& out, const ToroidalPatch& patch, std::uint32_t part) const;
  /// Appends the cells of the points that are nearest to an atom of this part; nothing if all atoms are of the part.
  void part_cells(SceneText& out, const ConcavePatch& patch, std::uint32_t part) const;
  void box(SceneText& out, const glm::dvec3& low, const glm::dvec3& high) const;
  /// Appends a half-space. Its written plane is most exact near `anchor`, a point near the patch.
  void plane(SceneText& out, const Plane& plane, const glm::dvec3& anchor) const;
  Box extent(const ColoredPiece& piece) const;
  /// Appends the planes of `clip_` that intersect the box of the piece.
  void cuts(SceneText& out, const ColoredPiece& piece) const;

  const Surface& surface_;
  const Palette& palette_;
  glm::dvec3 origin_;
  std::span<const ClipPlane> clip_;
};

/// Returns the box (Å) of one border arc, from its ends and the points where a coordinate is extreme.
Box arc_extent(const Border& border);

/// Returns the box (Å) of a toroidal patch. A saddle has no extreme point inside because its Gaussian curvature is
/// negative, so the box is that of the borders and, for a free spindle, of the cusp points on the axis.
/// patch.face_count must not be 0: without faces the box would be empty.
Box toroidal_extent(const Surface& surface, const ToroidalPatch& patch);

/// Returns the box (Å) of a concave patch, from its borders and the extreme points of the probe along the coordinate
/// axes that lie inside all planes. patch.face_count must not be 0.
Box concave_extent(const Surface& surface, const ConcavePatch& patch);

/// Returns the box of all atoms in all copies.
Box atom_extent(std::span<const SurfaceObject> objects);

/// Returns the centre of a box in Å, rounded to three decimals.
glm::dvec3 middle(const Box& extent);

/// Throws Error if the name of the scene is invalid, the picture has no pixels, or an object has no atom.
void check(std::span<const SurfaceObject> objects, const SceneOptions& options);

/// Returns sentences about atoms that are cut off, patches that are left out, and large memory use of POV-Ray.
std::vector<std::string> notes(std::span<const SurfaceObject> objects, const Geometry& geometry, const Camera& camera);

}  // namespace meniscus::povray
