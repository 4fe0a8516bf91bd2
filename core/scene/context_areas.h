// SPDX-License-Identifier: BSD-3-Clause
// The area of some atoms in the presence of others: how much of it is buried.
#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/area_columns.h"
#include "core/scene/molecule.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// The atoms that are around those of a molecule, and what they do to its areas.
struct ContextAreas {
  std::size_t atoms = 0;            ///< of the context alone
  std::vector<AreaColumn> columns;  ///< for each given one: "<name>_in_context", "<name>_buried" (the difference)
};

/// The request for the context's atoms too. Throws RequestError without --select (then there is nothing else in the
/// file), for standard input, which can be read only once, and for assemblies.
MoleculeRequest with_context(const MoleculeRequest& request, const Selection& context);

/// Computes the surface of all atoms of `together` as one, and finds those of the molecule there. `alone`: columns of
/// the molecule by itself. `computer`: of request.surface. Throws what computing a surface throws.
ContextAreas context_areas(const MoleculeRequest& request, const Structure& together, const Molecule& molecule,
                           const std::vector<AreaColumn>& alone, SurfaceComputer& computer);

}  // namespace meniscus
