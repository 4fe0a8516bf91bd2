// SPDX-License-Identifier: BSD-3-Clause
// Doubts about a file that is well-formed: atoms at one place, coordinates in another unit.
#pragma once

namespace meniscus {

struct Structure;

/// Warns of atoms at exactly the place of another, each with both names.
void warn_of_coincident_atoms(Structure& structure);

/// Warns where the median distance to the nearest atom of the same model and alternate location is below half an
/// ångström, as in a file in nanometres. The median is that of at most 64 atoms, evenly spread.
void warn_of_wrong_unit(Structure& structure);

}  // namespace meniscus
