// SPDX-License-Identifier: BSD-3-Clause
// Turns surfaces with their colours, and pockets, into objects of a mesh file; finds a point inside each cavity and
// solid.
#pragma once

#include "core/mesh/mesh_objects.h"
#include "core/mesh/weld.h"
#include "core/queries/surface_object.h"
#include "exporters/mesh_files/mesh_formats.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {

/// Returns one point per component of a surface. The point lies on the inner side of the component, which is the
/// solvent for a cavity and the solid otherwise, and on the inner side of its triangles. A ball around it touches this
/// component and contains nothing of the surface. If the triangles are too coarse for such a point, it lies on their
/// inner side only, close to one of them. mesh: the closed mesh of the whole surface. Throws OpenSurfaceError for a
/// component without such a point at any of the places tried.
std::vector<glm::dvec3> inner_points(const Surface& surface, const TriangleMesh& mesh);

/// Vertices nearer together than this (Å) are welded, because files hold floats and programs print three decimals.
inline constexpr double kFileStep = 0.001;

/// The content and fineness of a file, in addition to the surfaces themselves.
struct FileRequest {
  MeshFineness fineness;
  std::vector<std::string> numbers;  ///< names of vertex_number_kinds()
  double scale = 1.0;                ///< the length of 1 Å in the unit of the file
  std::span<const Atom> atoms;       ///< SurfaceObject::atom and SurfaceView::atom are indices into these
  std::span<const double> buried;    ///< buried area of each of these atoms, Å²; empty if unknown
  bool inner_points = false;         ///< true if a point inside each cavity and each solid is needed
  /// Velocity of each of these atoms, Å per frame; empty if unknown. A surface in several places has no velocities.
  std::span<const glm::dvec3> velocities = {};
  bool places = false;  ///< true if the format can place an object several times (MeshFormat::places)
  FileMaterial material = {};
};

/// Returns one line about a file: the program, the length of 1 Å, the kind of surface (such as "solvent-excluded"), and
/// the fineness.
std::string about_line(std::string_view surface, double scale, const MeshFineness& fineness);

/// Makes a file object by object.
class MeshFileMaker {
 public:
  MeshFileMaker(FileRequest request, std::string about);

  /// Meshes and welds a whole surface in all its places, and then leaves out hidden parts. The places share one mesh if
  /// the format supports this and if no colour, number or triangle depends on the place. Throws what tessellate() and
  /// even_mesh() throw.
  void add(SurfaceObject object);
  /// Adds a surface that has a mesh already.
  void add(const SurfaceView& object, FineMesh mesh);
  /// Adds shapes that are drawn in addition to a surface.
  void add(ShapeObject shapes);

  std::size_t triangle_count() const { return triangles_; }
  /// Returns the number of places of all meshes that share one, without the first place of each.
  std::size_t further_places() const { return further_places_; }
  std::size_t joined_edges() const { return joined_; }
  std::size_t flipped_edges() const { return flipped_; }
  std::size_t fins() const { return fins_; }
  /// Returns the number of triangles without area that remain, because welding them would leave the mesh open, pinched
  /// or folded.
  std::size_t flat_triangles() const { return flat_; }

  /// Returns the file. It must be called once, after all other members. Throws RequestError where no triangle is shown.
  MeshFile take();

 private:
  bool can_share_mesh(const SurfaceObject& object) const;
  void add_meshed(const SurfaceView& object, FineMesh mesh, std::vector<glm::dvec3> velocities = {});

  FileRequest request_;
  MeshFile file_;
  std::uint32_t components_ = 0;
  std::size_t triangles_ = 0, further_places_ = 0, joined_ = 0, fins_ = 0, flipped_ = 0, flat_ = 0;
};

/// Returns a file with one object per pocket from the mesh of pocket_mesh(). Objects are named "pocket 1", ... by rank
/// and have the rank as vertex number "pocket"; colours are those of categorical_color(). Lengths are in Å. The file
/// has neither atoms nor inner points, so it suits formats that need neither.
MeshFile pocket_file(const TriangleMesh& mesh);

}  // namespace meniscus
