// SPDX-License-Identifier: BSD-3-Clause
// Tries the equal signs of a text from the left.
#include "core/structure/selection/selection_and_text.h"

#include "core/base/error.h"

namespace meniscus {

std::optional<SelectionAndText> selection_and_text(std::string_view text) {
  for (std::size_t sign = text.find('='); sign != std::string_view::npos; sign = text.find('=', sign + 1)) {
    try {
      return SelectionAndText{parse_selection(text.substr(0, sign)), text.substr(sign + 1)};
    } catch (const SelectionError&) {
      continue;  // this sign is part of a comparison
    }
  }
  return std::nullopt;
}

}  // namespace meniscus
