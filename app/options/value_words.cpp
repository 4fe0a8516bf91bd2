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

CLI::Validator one_of(const std::vector<std::string>& words) { return one_of(words, words); }

CLI::Validator one_of(const std::vector<std::string>& words, const std::vector<std::string>& values) {
  const auto replace = [=](std::string& text) -> std::string {
    const auto word = std::ranges::find(words, text);
    if (word == words.end()) return fmt::format("{} is not one of {}", in_quotes(text), fmt::join(words, ", "));
    text = values[static_cast<std::size_t>(word - words.begin())];
    return {};
  };
  return CLI::Validator(replace, "", CLI::detail::join(words, "|"));
}

}  // namespace meniscus
