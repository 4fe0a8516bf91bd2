// SPDX-License-Identifier: BSD-3-Clause
// Makes the checks of CLI11 that know the words of an option's value.
#include "app/options/value_words.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"

namespace meniscus {

CLI::Validator proposes(const std::vector<std::string>& words) {
  return CLI::Validator([](std::string&) { return std::string(); }, "", CLI::detail::join(words, "|"));
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  const auto check = [words](std::string& text) -> std::string {
    if (std::ranges::find(words, text) != words.end()) return {};
    return fmt::format("{} is not one of {}", in_quotes(text), fmt::join(words, ", "));
  };
  return CLI::Validator(check, "", CLI::detail::join(words, "|"));
}

}  // namespace meniscus
