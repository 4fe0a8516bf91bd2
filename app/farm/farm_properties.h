// SPDX-License-Identifier: BSD-3-Clause
// The properties of farm bundles and of their workers.
#pragma once

#include <span>

#include "core/properties/properties.h"

namespace meniscus::farm {

/// Returns the table; the program adds it to properties().
std::span<const Property> farm_properties();

}  // namespace meniscus::farm
