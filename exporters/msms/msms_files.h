// SPDX-License-Identifier: BSD-3-Clause
// The text of .vert, .face and .area files, column by column as MSMS 2.6 writes them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/surface/atom_areas.h"
#include "exporters/msms/numbered_mesh.h"

namespace meniscus {

/// The spheres as they were given, some of which may have no ball in the surface.
struct MsmsSpheres {
  std::string file;                    ///< the name given, for headers
  std::vector<std::string> names;      ///< one each, for the last column; empty: no such column
  std::vector<std::uint32_t> of_atom;  ///< per Surface::atoms: which sphere, from 0
  std::size_t count = 0;
};

struct MsmsHeader {
  bool wanted = true;
  double density = 0.0;       ///< vertices per Å², as asked
  double probe_radius = 0.0;  ///< Å
};

/// Rows of nine columns, ten with names: position, normal, face, closest sphere (from 1), level, name.
std::string vert_text(const MsmsMesh& mesh, const MsmsSpheres& spheres, const MsmsHeader& header);

/// Rows of five: corners (from 1), kind, face.
std::string face_text(const MsmsMesh& mesh, const MsmsSpheres& spheres, const MsmsHeader& header);

/// The same mesh as OFF, as NanoShaper writes it unless it is asked for the files of MSMS: corners from 0.
std::string off_text(const MsmsMesh& mesh);

/// A line of titles, then a row for each sphere: its number from 0, areas of each component (solvent-excluded,
/// solvent-accessible, Å²), name. areas: one for each component.
std::string area_text(std::span<const AtomAreas> areas, const MsmsSpheres& spheres);

}  // namespace meniscus
