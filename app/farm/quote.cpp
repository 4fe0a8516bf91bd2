// SPDX-License-Identifier: BSD-3-Clause
// Quotes by the rules of each language.
#include "app/farm/quote.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus::farm {

std::string xml_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&apos;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string json_text(std::string_view text) { return nlohmann::json(text).dump(-1, ' ', true); }

void require_printable_path(const std::string& what, std::string_view path) {
  const auto control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  bool speakable = std::ranges::none_of(path, control);
  try {
    json_text(path);
  } catch (const nlohmann::json::type_error&) {
    speakable = false;
  }
  if (!speakable)
    throw RequestError(
        fmt::format("{}: {} has control characters or is not UTF-8; choose another path", what, in_quotes(path)));
}

}  // namespace meniscus::farm
