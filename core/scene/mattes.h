// SPDX-License-Identifier: BSD-3-Clause
// Mattes of the parts of a picture: by chain, by residue and by atom.
#pragma once

#include <memory>
#include <vector>

#include "core/image/cryptomatte.h"

namespace meniscus {

struct Structure;

/// Returns CryptoChain, CryptoResidue and CryptoAtom of shown_atoms(): "A", "A/LYS 15", "A/LYS 15/CA", with "-" for a
/// name that the file does not give. The place in the file distinguishes atoms of one name: the second has "#42"
/// appended. Copies of one atom (Instances) share a name.
std::shared_ptr<const std::vector<Matte>> mattes_of(const Structure& structure);

}  // namespace meniscus
