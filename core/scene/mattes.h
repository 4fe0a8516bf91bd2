// SPDX-License-Identifier: BSD-3-Clause
// Mattes of what a picture shows: by chain, by residue and by atom.
#pragma once

#include <memory>
#include <vector>

#include "core/image/cryptomatte.h"

namespace meniscus {

struct Structure;

/// CryptoChain, CryptoResidue and CryptoAtom of shown_atoms(): "A", "A/LYS 15", "A/LYS 15/CA", and "-" for what a file
/// does not say. Atoms of one name are told apart by their place in the file: the second has "#42" behind it. Copies of
/// one atom (Instances) are one.
std::shared_ptr<const std::vector<Matte>> mattes_of(const Structure& structure);

}  // namespace meniscus
