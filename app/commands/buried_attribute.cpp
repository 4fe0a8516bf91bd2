// SPDX-License-Identifier: BSD-3-Clause
// Computes chains alone and together; the difference is the area that they bury.
#include "app/commands/buried_attribute.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/open_book.h"

namespace meniscus {

std::vector<double> buried_by_chains(const MoleculeRequest& molecule, const Structure& structure,
                                     std::vector<std::string>& names, bool all) {
  const auto wanted = std::ranges::find(names, "buried_area");
  if (wanted == names.end()) return {};
  if (!structure.instances.empty()) {
    if (!all) throw RequestError("areas buried between copies need copies made of atoms; leave --instances out");
    names.erase(wanted);
    return {};
  }
  SurfaceComputer computer(molecule.surface);
  return buried_areas(structure, group_atoms(structure, Grouping::chain), computer, molecule.surface.kind);
}

}  // namespace meniscus
