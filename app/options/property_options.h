// SPDX-License-Identifier: BSD-3-Clause
// Adds options to a command as the table of properties declares them; the caller only binds their values.
#pragma once

#include <concepts>
#include <functional>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/properties/properties.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// Lets any value pass, and proposes these. The name of a check is where command_tree() finds its words.
CLI::Validator proposes(const std::vector<std::string>& words);

/// Takes one of these words, and nothing else.
CLI::Validator one_of(const std::vector<std::string>& words);

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
    if (words_of(property).size() != meanings.size())
      throw std::logic_error("words and meanings differ: " + std::string(key));
    return add_parsed(key, [&property, &target, values = std::vector<Meaning>(meanings)](const std::string& text) {
      const std::size_t place = place_of_word(property, text);
      target = values[place];
    });
  }

  /// Text that `parse` understands.
  CLI::Option* add_parsed(std::string_view key, const std::function<void(const std::string&)>& parse);
  /// A selection of atoms. Throws SelectionError that names the option.
  CLI::Option* add_selection(std::string_view key, std::optional<Selection>& selection);
  /// A flag that does something.
  CLI::Option* add_switch(std::string_view key, const std::function<void()>& turn_on);

 private:
  /// Throws CLI::ValidationError unless text is one of the words.
  static std::size_t place_of_word(const Property& property, const std::string& text);
  CLI::Option* finish(const Property& property, CLI::Option* option) const;

  CLI::App& command_;
};

/// What a word of a property means; `meanings` in the order of its words, the first where the text is empty. Throws
/// UsageError.
std::size_t place_of(const std::string& text, const Property& property);
template <typename Meaning>
Meaning meaning_of(const std::string& text, std::string_view key, std::initializer_list<Meaning> meanings) {
  return text.empty() ? *meanings.begin() : *(meanings.begin() + place_of(text, property_of(key)));
}

/// The heading of the help under which a property's option is; empty: the help does not have it.
std::string group_of(const Property& property);

/// Understands an expression that is the value of an option. Throws SelectionError, which names the option.
Selection parse_selection_option(const std::string& option, const std::string& text);

}  // namespace meniscus
