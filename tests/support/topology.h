// SPDX-License-Identifier: BSD-3-Clause
// What stays the same when a molecule is moved, reordered or mirrored, as one comparable sentence.
#pragma once

#include <string>

#include "core/surface/primitives.h"

namespace meniscus::testing {

/// All counts, and kind and Euler number of every component in a fixed order.
std::string topology_of(const Surface& surface);

}  // namespace meniscus::testing
