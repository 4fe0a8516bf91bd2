// SPDX-License-Identifier: BSD-3-Clause
// The tables of everything that a user can choose: options and their help, scene keys, bundles and the preview's
// controls follow from them.
#pragma once

#include <span>
#include <string_view>

#include "core/properties/property.h"

namespace meniscus {

/// All properties: sections in the order in which scene files are written, properties in that of the help.
std::span<const Property* const> properties();

/// The property of this key. Throws std::logic_error where there is none: keys are written by programmers.
const Property& property_of(std::string_view key);

}  // namespace meniscus
