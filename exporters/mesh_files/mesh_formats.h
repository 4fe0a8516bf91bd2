// SPDX-License-Identifier: BSD-3-Clause
// The table of the formats of mesh files, with the name, the features and the writer of each, and the numbers that
// vertices may have in them: properties of the surface, of the atom, of the residue.
#pragma once

#include "core/base/output_file.h"
#include "core/color/coloring.h"
#include "core/mesh/mesh_objects.h"
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

}  // namespace meniscus
