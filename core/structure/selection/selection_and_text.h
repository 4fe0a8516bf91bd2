// SPDX-License-Identifier: BSD-3-Clause
// Parts "EXPR=TEXT" where the selection ends, for both sides may have equal signs.
#pragma once

#include <optional>
#include <string_view>

#include "core/structure/selection/selection.h"

namespace meniscus {

struct SelectionAndText {
  Selection atoms;
  std::string_view text;  ///< all that follows the sign
};

/// Parts the text at the first "=" before which there is a whole selection: "resid 17=K17=A" means the text "K17=A",
/// "bfactor>=50=red" the text "red". Nothing if there is no such sign.
std::optional<SelectionAndText> selection_and_text(std::string_view text);

}  // namespace meniscus
