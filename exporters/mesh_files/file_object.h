// SPDX-License-Identifier: BSD-3-Clause
// From surfaces with their colours, and from pockets, to objects of a mesh file.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh_objects.h"
#include "core/mesh/shape_mesh.h"
#include "core/mesh/weld.h"
#include "core/queries/surface_object.h"
#include "exporters/mesh_files/mesh_file.h"
#include "exporters/mesh_files/mesh_formats.h"
#include "exporters/mesh_files/vertex_numbers.h"

namespace meniscus {

struct Atom;
struct TriangleMesh;

/// Files hold floats, programs print three decimals: what is nearer together than this (Å) is welded.
inline constexpr double kFileStep = 0.001;

/// What files are made of beside the surfaces themselves.
struct FileRequest {
  MeshFineness fineness;
  std::vector<std::string> numbers;  ///< names of vertex_number_kinds()
  double scale = 1.0;                ///< of the file's unit: what 1 Å is
  std::span<const Atom> atoms;       ///< SurfaceObject::atom and SurfaceView::atom point into these
  std::span<const double> buried;    ///< Å² of each of these atoms; empty: unknown
  bool inner_points = false;
  /// Å per frame, of each of these atoms; empty: unknown. A surface in several places has none.
  std::span<const glm::dvec3> velocities = {};
  bool places = false;  ///< the format has objects in several places
  FileMaterial material = {};
};

/// One line about a file: the program, what 1 Å is, which surface ("solvent-excluded", say), how fine.
std::string about_line(std::string_view surface, double scale, const MeshFineness& fineness);

/// Makes a file object by object.
class MeshFileMaker {
 public:
  MeshFileMaker(FileRequest request, std::string about);

  /// Meshes and welds all of a surface, in all its places; then what is hidden is left out. One mesh is in all places
  /// where the format has these and none of its colours, numbers and triangles depends on the place. Throws what
  /// tessellate() and even_mesh() throw.
  void add(SurfaceObject object);
  /// Of a surface that has a mesh already.
  void add(const SurfaceView& object, FineMesh mesh);
  /// Shapes beside it.
  void add(ShapeObject shapes);

  std::size_t triangle_count() const { return triangles_; }
  /// In how many places the meshes are beyond their first ones.
  std::size_t further_places() const { return further_places_; }
  std::size_t joined_edges() const { return joined_; }
  std::size_t flipped_edges() const { return flipped_; }
  std::size_t fins() const { return fins_; }
  /// Triangles without area that stay, where welding would leave the mesh open, pinched or folded.
  std::size_t flat_triangles() const { return flat_; }

  /// Call once, last. Throws RequestError where no triangle is shown.
  MeshFile take();

 private:
  bool may_share(const SurfaceObject& object) const;
  void put(const SurfaceView& object, FineMesh mesh, std::vector<glm::dvec3> velocities = {});

  FileRequest request_;
  MeshFile file_;
  std::uint32_t components_ = 0;
  std::size_t triangles_ = 0, further_places_ = 0, joined_ = 0, fins_ = 0, flipped_ = 0, flat_ = 0;
};

/// mesh: as pocket_mesh() makes it. Objects are named "pocket 1", ... by rank and have the rank as vertex number
/// "pocket"; colours are those of categorical_color(). Lengths are in Å. No atoms, no inner points: for formats that
/// need neither.
MeshFile pocket_file(const TriangleMesh& mesh);

}  // namespace meniscus
