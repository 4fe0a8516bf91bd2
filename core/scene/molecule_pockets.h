// SPDX-License-Identifier: BSD-3-Clause
// The pockets of a molecule, and where in them the ligands lie that were taken out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/pockets/pockets.h"
#include "core/scene/surface_computer.h"
#include "core/structure/structure.h"

namespace meniscus {

/// A residue that was taken out, such as a ligand.
struct LeftOutResidue {
  std::uint32_t first_atom = 0;  ///< into Structure::atoms
  std::size_t atoms = 0;
  std::vector<std::size_t> in_pocket;  ///< per pocket: how many of its atoms have their centre there
};

struct MoleculePockets {
  Pockets found;  ///< atoms of cavities and surfaces are places in Structure::atoms
  std::vector<LeftOutResidue> left_out;
  std::size_t atom_count = 0;  ///< those that pockets are between
};

/// Finds the pockets of one structure after another on one device.
class PocketComputer {
 public:
  /// computing: where; its kind is that of solvent-excluded surfaces, its probe is the request's.
  PocketComputer(SurfaceRequest computing, const PocketRequest& request);

  /// left_out: one per atom of the structure, or empty. Throws RequestError if nothing else is there, what find_pockets
  /// throws.
  MoleculePockets compute(const Structure& structure, const std::vector<bool>& left_out);

  bool is_on_cpu() const { return small_.is_on_cpu(); }
  const std::string& device() const { return small_.device(); }

 private:
  PocketRequest request_;
  SurfaceComputer small_, large_;
};

}  // namespace meniscus
