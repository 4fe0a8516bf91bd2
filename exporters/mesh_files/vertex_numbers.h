// SPDX-License-Identifier: BSD-3-Clause
// Numbers that vertices of a mesh may have in files: of the surface there, of its atom, of its residue.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/color/coloring.h"
#include "core/mesh/mesh_objects.h"
#include "core/surface/primitives.h"
#include "exporters/mesh_files/mesh_file.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus {

struct Atom;

/// One of them.
struct VertexNumberKind {
  std::string_view name;  ///< of the column
  std::string_view description;
  bool usual;         ///< there unless others are asked for
  bool of_molecule;   ///< told by a molecule's file alone
  bool slow = false;  ///< takes seconds or minutes, so that only its own name asks for it
};

std::span<const VertexNumberKind> vertex_number_kinds();

/// Names between commas; "usual", "all" and "none" stand for several. Every name once, in the order of the table. With
/// bare atoms, of which nothing but places and radii is known, those of a molecule are left out. Throws RequestError
/// naming the word that is not one of them, or that bare atoms do not have.
enum class AtomSource { molecule, bare };
std::vector<std::string> parse_vertex_numbers(std::string_view text, AtomSource atoms = AtomSource::molecule);

/// A surface, in one place, and what a file says of it.
struct SurfaceView {
  std::string_view name;  ///< text of a molecule file may be in it
  const Surface& surface;
  const Coloring& coloring;
  std::span<const std::uint32_t> atom;  ///< per surface.atoms: into the atoms of the file
};

/// What they are taken from.
struct NumberSource {
  SurfaceView object;
  const FineMesh& mesh;
  std::span<const Atom> atoms;     ///< SurfaceView::atom points into these
  std::span<const double> buried;  ///< Å² of each of these atoms; empty: unknown
  std::uint32_t first_component;   ///< of the object's components, the number of the first in the file
};

/// The columns with these names, NaN where something has no such number: charges of formats without, residues without a
/// hydropathy, curvature of shapes beside the surface. With a volume map a column `map_value`, too.
std::vector<VertexNumbers> vertex_numbers(std::span<const std::string> names, const NumberSource& source);

}  // namespace meniscus
