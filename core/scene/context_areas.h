// SPDX-License-Identifier: BSD-3-Clause
// What becomes of the area of some atoms in the presence of others: how much of it is buried.
#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/area_columns.h"
#include "core/scene/molecule.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// The atoms that stand around those of a molecule, and what they do to its areas.
struct ContextAreas {
  std::size_t atoms = 0;            ///< of the context alone
  std::vector<AreaColumn> columns;  ///< for each given one: "<name>_in_context", "<name>_buried" (the difference)
};

/// Reads the file again with the context's atoms too, and computes the surface of all of them together, as one.
/// `alone`: columns of the molecule by itself. Throws RequestError without --select (then there is nothing else in the
/// file), for standard input, which can be read only once, and for assemblies; and what loading a molecule throws.
ContextAreas context_areas(const MoleculeRequest& request, const Selection& context, const Molecule& molecule,
                           const std::vector<AreaColumn>& alone);

}  // namespace meniscus
