// SPDX-License-Identifier: BSD-3-Clause
// The table of the formats of mesh files, with the name, the features and the writer of each, and the numbers that
// vertices may have in them: properties of the surface, of the atom, of the residue; and the objects of a file, made of
// surfaces with their colours and of pockets.
#pragma once

#include "core/base/output_file.h"
#include "core/color/coloring.h"
#include "core/mesh/mesh_objects.h"
#include "core/mesh/weld.h"
#include "core/queries/surface_object.h"
#include "core/surface/primitives.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {

/// A number that each vertex may have.
struct VertexNumberKind {
  std::string_view name;  ///< name of the column
  std::string_view description;
  bool usual;         ///< true if it is written by default
  bool of_molecule;   ///< true if only molecules read from a file have it
  bool slow = false;  ///< true if it takes seconds or minutes, so that "all" does not include it
};

std::span<const VertexNumberKind> vertex_number_kinds();

/// The source of the atoms: a molecule, or bare positions and radii.
enum class AtomSource { molecule, bare };

/// Returns the names in a list with commas, each once and in the order of the table. The word "usual" or "all" stands
/// for several names, "none" for no name. Bare atoms lack the numbers of molecules. Throws RequestError with a word
/// that is not a name, or that bare atoms do not have.
std::vector<std::string> parse_vertex_numbers(std::string_view text, AtomSource atoms = AtomSource::molecule);

/// A surface in one place, with its name, colours and atoms.
struct SurfaceView {
  std::string_view name;  ///< may contain text from a molecule file
  const Surface& surface;
  const Coloring& coloring;
  std::span<const std::uint32_t> atom;  ///< index into the atoms of the file, per atom of the surface
};

/// The data from which vertex numbers are computed.
struct NumberSource {
  SurfaceView object;
  const FineMesh& mesh;
  std::span<const Atom> atoms;     ///< SurfaceView::atom contains indices into these
  std::span<const double> buried;  ///< buried area of each of these atoms, Å²; empty if unknown
  std::uint32_t first_component;   ///< number in the file of the object's first component
};

/// Returns the columns with these names, and a column `map_value` if there is a volume map. Values are NaN if a vertex
/// has no such number: charges in formats without them, residues without a hydropathy, curvature of shapes.
std::vector<VertexNumbers> vertex_numbers(std::span<const std::string> names, const NumberSource& source);

/// The range of the length of 1 Å in a file.
inline constexpr double kSmallestFileScale = 1e-12, kLargestFileScale = 1e6;

/// A format of mesh files.
struct MeshFormat {
  std::string_view word;   ///< short name, which is also the ending of its files (without the dot), except ply-ascii
  std::string_view title;  ///< name in messages and help
  std::string_view unit;   ///< unit of length that the format prescribes; empty if it prescribes none
  bool objects;            ///< true if a file may have several objects, with names
  bool colors;
  bool numbers;  ///< true if vertices may have VertexNumbers
  bool solid;    ///< true if programs fill it: it needs one closed surface and its inner points
  bool atoms;    ///< true if it contains names of atoms
  bool places;   ///< true if an object may be in several places at once
  bool opacity;  ///< true if vertices may have opacities
  void (*write)(OutputFile& file, const MeshFile& mesh);
  /// Writes all frames of a run, at least one, into one file; nullptr if each frame needs a file of its own.
  void (*write_run)(OutputFile& file, std::span<const MeshFile> frames, const RunTimes& times) = nullptr;
};

std::span<const MeshFormat> mesh_formats();

/// Returns the format with this word, or nullptr.
const MeshFormat* mesh_format(std::string_view word);
/// Returns the format of a path by its ending in any case, or nullptr.
const MeshFormat* mesh_format_of_path(std::string_view path);

/// Returns the words of all formats: "stl, 3mf, ...".
std::string mesh_format_words();

/// Writes the file whole or not at all. Objects are joined if the format allows only one. Throws OutputError, and
/// CapacityError for a mesh that exceeds the limits of the format.
void write_mesh_file(const MeshFormat& format, const std::string& path, Existing existing, MeshFile mesh);
/// Writes a run in a format that has write_run. Throws what write_mesh_file() throws.
void write_mesh_run(const MeshFormat& format, const std::string& path, Existing existing,
                    std::span<const MeshFile> frames, const RunTimes& times);

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

/// Returns a line about a file: program, length of 1 Å, kind of surface (such as "solvent-excluded"), fineness.
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
  /// Returns the number of flat triangles that remain, because welding would leave the mesh open, pinched or folded.
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

/// Returns a file with one object per pocket from the mesh of pocket_mesh(). Objects are named "pocket 1", ... by rank.
/// The vertex number "pocket" is the rank, and categorical_color() gives the colours. Lengths are in Å. The file has
/// neither atoms nor inner points, so it suits formats that need neither.
MeshFile pocket_file(const TriangleMesh& mesh);

}  // namespace meniscus
