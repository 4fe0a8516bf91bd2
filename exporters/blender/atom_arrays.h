// SPDX-License-Identifier: BSD-3-Clause
// The arrays of the atoms of an object, as all files for Blender have them, and what Blender gets to know of each atom.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/queries/surface_object.h"
#include "core/structure/structure.h"
#include "exporters/blender/mns_file.h"

namespace meniscus::blender {

/// Numbers per atom, in the order of Surface::atoms; an empty vector leaves the attribute out.
/// The names in the file are those of Molecular Nodes where it has them: b_factor, atomic_number, res_id, chain_id.
struct AtomAttributes {
  std::vector<std::uint32_t> file_index;  ///< place in the file, from 0 (Atom::index)
  std::vector<float> b_factor;
  std::vector<float> charge;          ///< e; 0: unknown
  std::vector<float> hydrophobicity;  ///< of the residue (Kyte & Doolittle 1982); 0: it has none
  std::vector<std::int32_t> atomic_number;
  std::vector<std::int32_t> residue_number;
  std::vector<std::int32_t> entity;                                 ///< AtomClass
  std::vector<std::int32_t> chain;                                  ///< into chain_names
  std::vector<std::int32_t> name;                                   ///< into atom_names
  std::vector<std::int32_t> residue_name;                           ///< into residue_names
  std::vector<std::string> chain_names, atom_names, residue_names;  ///< text of a molecule file, each once
  /// Å²: of the surface, of what a probe's centre can reach, of the latter what other chains bury.
  std::vector<float> area, accessible_area, buried_area;
};

/// atom.center, atom.radius, atom.color, atom.index, and what else is known of them (FORMAT.md). What is added refers
/// to the object and to the attributes until the file is written.
void add_atoms(MnsWriter& file, const SurfaceObject& object, const AtomAttributes& atoms);

/// The lists of names that arrays of atoms point into, as the header of the object has them.
void add_names(nlohmann::json& header, const AtomAttributes& atoms);

/// Of these atoms of the structure, in this order.
AtomAttributes atom_attributes(const Structure& structure, const std::vector<std::uint32_t>& atoms);

}  // namespace meniscus::blender
