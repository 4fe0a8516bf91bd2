// SPDX-License-Identifier: BSD-3-Clause
// The numbers that vertices of a mesh may have in files: properties of the surface, of the atom, of the residue.
#pragma once

#include "core/color/coloring.h"
#include "core/mesh/mesh_objects.h"
#include "core/surface/primitives.h"
#include "exporters/mesh_files/mesh_formats.h"
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

/// Returns the names in a text that separates them by commas, each once and in the order of the table. "usual" and
/// "all" are replaced by several names, "none" by no name. For bare atoms, of which only positions and radii are known,
/// the numbers of molecules are left out. Throws RequestError with the word that is no such name, or that bare atoms do
/// not have.
enum class AtomSource { molecule, bare };
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

}  // namespace meniscus
