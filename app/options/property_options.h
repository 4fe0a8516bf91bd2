// SPDX-License-Identifier: BSD-3-Clause
// The properties that a command takes, options for them, and a scene as options of a command line.
#pragma once

#include <concepts>
#include <functional>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/properties/properties.h"
#include "core/scene/idle_values.h"
#include "core/scene/scene.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// The scene's properties for which a command has options, and conditions of their effect. Each command declares its
/// own: those of a common set below, and more or fewer. Options that no scene has are added by the command itself.
class TakenProperties {
 public:
  /// names: headings of the help, such as "Colour", and keys, such as "molecule.quiet"; one that begins with a minus is
  /// left out. The last one that names a property decides. Throws std::logic_error for a name that is neither. needs:
  /// conditions that this command adds to those of all scenes.
  TakenProperties(std::initializer_list<std::string_view> names, std::initializer_list<Need> needs = {}) {
    add(names, needs);
  }

  /// Returns a copy with more and fewer properties, and more conditions.
  TakenProperties with(std::initializer_list<std::string_view> names, std::initializer_list<Need> needs = {}) const;

  bool has(const Property& property) const { return taken_.contains(&property); }
  bool has(std::string_view key) const { return has(property_of(key)); }
  const std::vector<Need>& needs() const { return needs_; }

 private:
  void add(std::initializer_list<std::string_view> names, std::initializer_list<Need> needs);

  std::set<const Property*> taken_;
  std::vector<Need> needs_;
};

/// Returns the properties of every command that computes surfaces of a molecule or of a run of frames.
const TakenProperties& run_properties();
/// Returns the properties of every export of a figure.
const TakenProperties& figure_properties();
/// Returns the properties of `meniscus render`.
const TakenProperties& render_properties();

/// Returns the condition of options for films: the output is one.
Need film_need();
/// Returns the condition of options that turn and move frames. condition: a table of places or directions is written.
Need superposition_need(Condition condition);

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

/// Returns FILE, and an option for each value that differs from Scene{}, but for where its output goes. path: what is
/// written instead of the path of a file that is read.
std::vector<std::string> scene_words(const Scene& scene,
                                     const std::function<std::string(const std::string& path)>& path = {});

/// "meniscus", "render" and the same, with the output.
std::vector<std::string> render_words(const Scene& scene);

/// As a shell takes them, in one line.
std::string shell_line(std::span<const std::string> words);

}  // namespace meniscus
