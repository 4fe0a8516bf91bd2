// SPDX-License-Identifier: BSD-3-Clause
// Turns a row of the table of properties into an option of CLI11: names, help, heading, and what its value may be.
#include "app/options/property_options.h"

#include <fmt/format.h>

#include "app/options/molecule_options.h"
#include "core/base/text.h"
#include "core/text/parse_number.h"

namespace meniscus {

CLI::Option* PropertyOptions::add_parsed(std::string_view key, const std::function<void(const std::string&)>& parse) {
  const Property& property = property_of(key);
  return finish(property, command_.add_option_function<std::string>(std::string(property.option), parse));
}

CLI::Option* PropertyOptions::add_list(std::string_view key,
                                       const std::function<void(const std::vector<std::string>&)>& parse) {
  const Property& property = property_of(key);
  return finish(property, command_.add_option_function<std::vector<std::string>>(std::string(property.option), parse));
}

CLI::Option* PropertyOptions::add_numbers(std::string_view key,
                                          const std::function<void(const std::vector<float>&)>& parse) {
  const Property& property = property_of(key);
  return finish(property, command_.add_option_function<std::vector<float>>(std::string(property.option), parse));
}

CLI::Option* PropertyOptions::add_selection(std::string_view key, std::optional<Selection>& selection) {
  const std::string name(property_of(key).long_option());
  return add_parsed(key, [name, &selection](const std::string& text) { selection = parse_selection_option(name, text); });
}

CLI::Option* PropertyOptions::add_switch(std::string_view key, const std::function<void()>& turn_on) {
  const Property& property = property_of(key);
  return finish(property, command_.add_flag_callback(std::string(property.option), turn_on));
}

CLI::Option* PropertyOptions::finish(const Property& property, CLI::Option* option) const {
  option->description(help_of(property))->group(std::string(property.heading));
  if (property.type == ValueType::flag) return option;
  option->type_name(std::string(property.value));
  if (property.has(repeatable)) option->allow_extra_args(false);
  if (property.has(value_optional)) option->expected(0, 1);
  // The range of a text is that of a length in pixels, which its own parser checks.
  if (property.has_range() && (property.type == ValueType::number || property.type == ValueType::count))
    option->check(within(property.lowest, property.highest));
  if (!property.words.empty() && property.type != ValueType::word) option->check(proposes(words_of(property)));
  return option;
}

CLI::Validator within(double lowest, double highest) {
  return CLI::Validator(
      [=](std::string& text) {
        double number = 0.0;
        if (parse_number(text, number) && number >= lowest && number <= highest) return std::string();
        return fmt::format("{} is not a number from {} to {}", in_quotes(text), lowest, highest);
      },
      "");
}

}  // namespace meniscus
