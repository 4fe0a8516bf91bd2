// SPDX-License-Identifier: BSD-3-Clause
// Reads and writes rules of colour: an expression for atoms, their colour, and the name in a legend.
#pragma once

#include <string>
#include <string_view>

#include "core/color/color_schemes.h"

namespace meniscus {

/// Parses "EXPR=red" or "EXPR=red:Name"; the part before the colon as parse_color_rule does. Throws RequestError,
/// SelectionError.
ColorRule named_color_rule(std::string_view text);

/// Formats a rule as named_color_rule reads it.
std::string color_rule_text(const ColorRule& rule);

}  // namespace meniscus
