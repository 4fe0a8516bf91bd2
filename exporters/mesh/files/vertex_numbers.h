// SPDX-License-Identifier: BSD-3-Clause
// The numbers that vertices of a mesh may have in files: of the surface there, of its atom, of its residue.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/queries/surface_object.h"
#include "core/structure/structure.h"
#include "exporters/mesh/files/mesh_file.h"
#include "exporters/mesh/mesh_fineness.h"

namespace meniscus {

/// One of them.
struct VertexNumberKind {
  std::string_view name;  ///< of the column
  std::string_view description;
  bool usual;  ///< there unless others are asked for
};

std::span<const VertexNumberKind> vertex_number_kinds();

/// Names between commas; "usual", "all" and "none" stand for several. Throws RequestError naming the word that is none
/// of them. Every name once, in the order of the table.
std::vector<std::string> parse_vertex_numbers(std::string_view text);

/// What they are taken from.
struct NumberSource {
  const SurfaceObject& object;
  const FineMesh& mesh;
  std::span<const Atom> atoms;     ///< SurfaceObject::atom points into these
  std::span<const double> buried;  ///< Å² of each of these atoms; empty: unknown
  std::uint32_t first_component;   ///< of the object's components, the number of the first in the file
};

/// The columns with these names, NaN where something has no such number: charges of formats without, residues without a
/// hydropathy, curvature of shapes beside the surface. With a volume map a column `map_value`, too.
std::vector<VertexNumbers> vertex_numbers(std::span<const std::string> names, const NumberSource& source);

}  // namespace meniscus
