// SPDX-License-Identifier: BSD-3-Clause
// Turns a row of the table of properties into an option of CLI11: names, help, heading, and what its value may be.
#include "app/options/property_options.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/process/program_error.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/parse_number.h"

namespace meniscus {
namespace {

/// Accepts numbers within the range of a property.
CLI::Validator within(const Property& property) {
  return CLI::Validator(
      [&property](std::string& text) -> std::string {
        double number = 0.0;
        std::int64_t whole = 0;
        const bool is_count = property.type == ValueType::count;
        if ((is_count ? parse_whole_number(text, whole) : parse_number(text, number)) &&
            property.is_within(is_count ? static_cast<double>(whole) : number))
          return {};
        const char* const kind = is_count ? "whole number" : "number";
        if (property.highest >= kUnlimited)
          return fmt::format("{} is not a {} of at least {}", in_quotes(text), kind, property.lowest);
        return fmt::format("{} is not a {} from {} to {}", in_quotes(text), kind, property.lowest, property.highest);
      },
      "");
}

}  // namespace

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

std::string group_of(const Property& property) { return std::string(property.has(rare) ? "" : property.heading); }

CLI::Option* PropertyOptions::add_parsed(std::string_view key, const std::function<void(const std::string&)>& parse) {
  const Property& property = property_of(key);
  return finish(property, command_.add_option_function<std::string>(std::string(property.option), parse));
}

CLI::Option* PropertyOptions::add_selection(std::string_view key, std::optional<Selection>& selection) {
  const std::string name(property_of(key).long_option());
  return add_parsed(key,
                    [name, &selection](const std::string& text) { selection = parse_selection_option(name, text); });
}

CLI::Option* PropertyOptions::add_switch(std::string_view key, const std::function<void()>& turn_on) {
  const Property& property = property_of(key);
  return finish(property, command_.add_flag_callback(std::string(property.option), turn_on));
}

std::size_t PropertyOptions::place_of_word(const Property& property, const std::vector<std::string>& words,
                                           const std::vector<std::string>& numbers, const std::string& text) {
  for (std::size_t place = 0; place < words.size(); ++place)
    if (text == words[place] || text == numbers[place]) return place;
  throw CLI::ValidationError(std::string(property.long_option()),
                             fmt::format("{} is not one of {}", in_quotes(text), fmt::join(words, ", ")));
}

CLI::Option* PropertyOptions::finish(const Property& property, CLI::Option* option) const {
  option->description(help_of(property))->group(group_of(property));
  if (property.type == ValueType::flag) return option;
  option->type_name(std::string(property.value));
  if (property.has(repeatable)) option->allow_extra_args(false);
  if (property.has(value_optional)) option->expected(0, 1);
  // The range of a text is that of a length in pixels, which its own parser checks.
  if (property.has_range() && (property.type == ValueType::number || property.type == ValueType::count))
    option->check(within(property));
  if (!property.words.empty()) option->check(proposes(words_of(property)));
  return option;
}

std::size_t place_of(const std::string& text, const Property& property) {
  const std::vector<std::string> words = words_of(property);
  const auto word = std::ranges::find(words, text);
  if (word == words.end())
    throw UsageError(
        fmt::format("{}: {} is not one of {}", property.long_option(), in_quotes(text), fmt::join(words, ", ")));
  return static_cast<std::size_t>(word - words.begin());
}

Selection parse_selection_option(const std::string& option, const std::string& text) {
  try {
    return parse_selection(text);
  } catch (const SelectionError& error) {
    throw SelectionError(option + ": " + error.sentence(), error.picture());
  }
}

}  // namespace meniscus
