// SPDX-License-Identifier: BSD-3-Clause
// Reads and writes rules of colour with their names.
#include "core/color/color_rule.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/selection/selection_and_text.h"

namespace meniscus {

ColorRule named_color_rule(std::string_view text) {
  const auto parted = selection_and_text(text);
  if (!parted) return parse_color_rule(text);  // reports the error
  const std::size_t colon = parted->text.find(':');
  if (colon == std::string_view::npos) return parse_color_rule(text);
  ColorRule rule = parse_color_rule(text.substr(0, text.size() - parted->text.size() + colon));
  rule.name = parted->text.substr(colon + 1);
  if (rule.name.empty())
    throw RequestError(in_quotes(text) + " has no name after its colon; as in 'chain A=red:Alpha'");
  return rule;
}

std::string color_rule_text(const ColorRule& rule) {
  return rule.atoms.text() + "=" + scheme_word(rule.paint) + (rule.name.empty() ? "" : ":" + rule.name);
}

}  // namespace meniscus
