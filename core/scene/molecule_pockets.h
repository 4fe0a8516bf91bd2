// SPDX-License-Identifier: BSD-3-Clause
// The pockets of a molecule, and the pockets that contain the ligands which were taken out.
#pragma once

#include "core/pockets/pockets.h"
#include "core/scene/surface_computer.h"
#include "core/structure/structure.h"

namespace meniscus {

/// A residue that was taken out, such as a ligand.
struct LeftOutResidue {
  std::uint32_t first_atom = 0;        ///< place in Structure::atoms
  std::size_t atoms = 0;               ///< number of the residue's atoms
  std::vector<std::size_t> in_pocket;  ///< per pocket: number of the residue's atoms with their centre in it
};

/// The pockets of a structure.
struct MoleculePockets {
  Pockets found;  ///< atoms of cavities and surfaces are places in Structure::atoms
  std::vector<LeftOutResidue> left_out;
  std::size_t atom_count = 0;  ///< number of atoms that the pockets are between
};

/// Finds the pockets of one structure after another on one device.
class PocketComputer {
 public:
  /// computing: the device and threads; the surface is always solvent-excluded, with the probe of `request`.
  PocketComputer(SurfaceRequest computing, const PocketRequest& request);

  /// Returns the pockets of a structure. left_out: one truth value per atom of the structure, true for atoms that are
  /// taken out; empty: none. Throws RequestError if all atoms are left out or the request is invalid (find_pockets),
  /// and OpenSurfaceError, CapacityError or GpuError if a surface cannot be computed.
  MoleculePockets compute(const Structure& structure, const std::vector<bool>& left_out);

  bool is_on_cpu() const { return small_.is_on_cpu(); }
  const std::string& device() const { return small_.device(); }

 private:
  PocketRequest request_;
  SurfaceComputer small_, large_;
};

}  // namespace meniscus
