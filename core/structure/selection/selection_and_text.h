// SPDX-License-Identifier: BSD-3-Clause
// Splits texts "EXPR=TEXT" at the end of the selection, because both sides may have equal signs.
#pragma once

#include <optional>
#include <string_view>

#include "core/structure/selection/selection.h"

namespace meniscus {

/// A selection and the text that follows it.
struct SelectionAndText {
  Selection atoms;
  std::string_view text;  ///< everything after the equal sign
};

/// Splits the text at the first "=" with a complete selection before it. "resid 17=K17=A" has the text "K17=A", and
/// "bfactor>=50=red" has the text "red". Returns nothing if there is no such sign.
std::optional<SelectionAndText> selection_and_text(std::string_view text);

}  // namespace meniscus
