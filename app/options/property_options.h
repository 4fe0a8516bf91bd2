// SPDX-License-Identifier: BSD-3-Clause
// Adds options to a command as the table of properties declares them; the caller says only where values go.
#pragma once

#include <concepts>
#include <functional>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/options/value_words.h"
#include "core/properties/properties.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// Name, heading, help, default, range and words of each option come from property_of(key). Options appear in the help
/// in the order in which they are added. What a function throws (CLI::ValidationError, SelectionError, RequestError)
/// passes through.
class PropertyOptions {
 public:
  explicit PropertyOptions(CLI::App& command) : command_(command) {}

  /// A flag; a number within its range; text, a path, or several of them as they are.
  template <typename Target>
  CLI::Option* add(std::string_view key, Target& target) {
    const Property& property = property_of(key);
    if constexpr (std::same_as<Target, bool>)
      return finish(property, command_.add_flag(std::string(property.option), target));
    else
      return finish(property, command_.add_option(std::string(property.option), target));
  }

  /// One of the property's words; `meanings` in their order.
  template <typename Target, typename Meaning>
  CLI::Option* add_word(std::string_view key, Target& target, std::initializer_list<Meaning> meanings) {
    const Property& property = property_of(key);
    std::vector<std::string> values;
    for (const Meaning& meaning : meanings) {
      if constexpr (std::is_enum_v<Meaning>)
        values.push_back(std::to_string(static_cast<int>(meaning)));
      else
        values.push_back(fmt::format("{}", meaning));
    }
    const std::vector<std::string> words = words_of(property);
    if (words.size() != values.size()) throw std::logic_error("words and meanings differ: " + std::string(key));
    CLI::Option* const option = command_.add_option(std::string(property.option), target);
    return finish(property, option)->transform(one_of(words, values));
  }

  /// Text that `parse` understands.
  CLI::Option* add_parsed(std::string_view key, const std::function<void(const std::string&)>& parse);
  /// Every text that was given of a repeatable option, in order.
  CLI::Option* add_list(std::string_view key, const std::function<void(const std::vector<std::string>&)>& parse);
  /// The numbers of one value.
  CLI::Option* add_numbers(std::string_view key, const std::function<void(const std::vector<float>&)>& parse);
  /// A selection of atoms. Throws SelectionError that names the option.
  CLI::Option* add_selection(std::string_view key, std::optional<Selection>& selection);
  /// A flag that does something.
  CLI::Option* add_switch(std::string_view key, const std::function<void()>& turn_on);

 private:
  CLI::Option* finish(const Property& property, CLI::Option* option) const;

  CLI::App& command_;
};

/// Understands an expression that is the value of an option. Throws SelectionError, which names the option.
Selection parse_selection_option(const std::string& option, const std::string& text);

}  // namespace meniscus
