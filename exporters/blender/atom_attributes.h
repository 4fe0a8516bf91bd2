// SPDX-License-Identifier: BSD-3-Clause
// What Blender gets to know of each atom beside its ball and its colour.
#pragma once

#include <cstdint>
#include <vector>

#include "core/structure/structure.h"
#include "exporters/blender/atom_arrays.h"

namespace meniscus::blender {

/// Of these atoms of the structure, in this order.
AtomAttributes atom_attributes(const Structure& structure, const std::vector<std::uint32_t>& atoms);

}  // namespace meniscus::blender
