// SPDX-License-Identifier: BSD-3-Clause
// Rules of colour as users write them: atoms, what they get, and the name that a legend has for them.
#pragma once

#include <string>
#include <string_view>

#include "core/color/color_schemes.h"

namespace meniscus {

/// Reads "EXPR=red" or "EXPR=red:Name"; what is before the colon as parse_color_rule does. Throws RequestError,
/// SelectionError.
ColorRule named_color_rule(std::string_view text);

/// The text that named_color_rule reads as this rule.
std::string color_rule_text(const ColorRule& rule);

}  // namespace meniscus
