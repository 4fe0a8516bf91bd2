// SPDX-License-Identifier: BSD-3-Clause
// Radii by element alone, as the set that is taken unless another is asked for.
#include "core/structure/radii.h"
#include "core/structure/radii/radii_set.h"
#include "core/structure/structure.h"

namespace meniscus {

const RadiiSet kBondiSet{"bondi", "by element; hydrogens are atoms of their own", "Bondi 1964, 1966", false,
                         [](const Atom& atom) -> std::optional<FoundRadius> {
                           const ElementRadius found = bondi_radius(atom.element);
                           return FoundRadius{found.radius,
                                              atom.element == 0 ? "unknown" : element_symbol(atom.element),
                                              source_name(found.source)};
                         }};

}  // namespace meniscus
