// SPDX-License-Identifier: BSD-3-Clause
// Text of a molecule file inside an XML attribute or element.
#pragma once

#include <string>
#include <string_view>

namespace meniscus {

/// Letters of ASCII as they are, what XML takes for its own as entities, all else as '_'.
inline std::string xml_text(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += c >= ' ' && c <= '~' ? c : '_';
  }
  return safe;
}

}  // namespace meniscus
