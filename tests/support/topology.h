// SPDX-License-Identifier: BSD-3-Clause
// One comparable sentence of everything that stays when a molecule is moved, reordered or mirrored.
#pragma once

#include <string>

#include "core/surface/primitives.h"

namespace meniscus::testing {

/// Returns all counts, and kind and Euler number of every component in a fixed order.
std::string topology_of(const Surface& surface);

}  // namespace meniscus::testing
