// SPDX-License-Identifier: BSD-3-Clause
// The area of some atoms in the presence of others: how much of it is buried.
#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/area_columns.h"
#include "core/scene/molecule.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// The atoms in the surroundings of a molecule, and their effect on its areas.
struct ContextAreas {
  std::size_t atoms = 0;            ///< number of atoms of the context alone
  std::vector<AreaColumn> columns;  ///< two per given column: "<name>_in_context", "<name>_buried" (the difference)
};

/// Returns the request extended by the atoms of the context. Throws RequestError without --select (then the file has no
/// other atoms), for standard input, which can be read only once, and for assemblies.
MoleculeRequest with_context(const MoleculeRequest& request, const Selection& context);

/// Computes the surface of all atoms of `together` as one, and takes the areas of the molecule's atoms from it. alone:
/// the columns of the molecule without its context. computer: must compute the surfaces of request.surface. Throws
/// OpenSurfaceError, CapacityError or GpuError if a surface cannot be computed, and Error if no part of it is left.
ContextAreas context_areas(const MoleculeRequest& request, const Structure& together, const Molecule& molecule,
                           const std::vector<AreaColumn>& alone, SurfaceComputer& computer);

}  // namespace meniscus
