// SPDX-License-Identifier: BSD-3-Clause
// The tables of everything that a user can choose: options and their help, scene keys, bundles and the preview's
// controls follow from them.
#pragma once

#include <span>
#include <string_view>

#include "core/properties/property.h"

namespace meniscus {

/// All properties: sections in the order in which scene files are written, properties in that of the help. Tables that
/// a program adds come last.
std::span<const Property* const> properties();

/// Adds the properties of a program that no scene has. Such a constant stands in a file of the program, so that its
/// table is added before properties() is first called.
struct PropertyTable {
  explicit PropertyTable(std::span<const Property> table);
};

/// The property of this key. Throws std::logic_error where there is none: keys are written by programmers.
const Property& property_of(std::string_view key);

}  // namespace meniscus
