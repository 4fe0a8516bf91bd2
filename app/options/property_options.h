// SPDX-License-Identifier: BSD-3-Clause
// The properties that a command takes, options for them, a scene as options of a command line, and the keys of scene
// files for people and for editors of JSON.
#pragma once

#include <set>

#include "core/properties/properties.h"
#include "core/scene/scene.h"
#include "core/scene/scene_values.h"
#include "core/structure/selection/selection.h"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace meniscus {

/// The scene's properties for which a command has options, and the conditions without which some of them have no
/// effect. Each command declares its own set: one of the common sets below this class, with some properties added or
/// removed. Options that scenes do not have are added by the command itself.
class TakenProperties {
 public:
  /// `names` are headings of the help, such as "Colour", and keys, such as "molecule.quiet". A name that begins with a
  /// minus removes its properties. Names apply in order, so a later one overrules an earlier one. `needs` are
  /// conditions that this command adds to the conditions of all scenes; ineffective_values() (scene_values.h)
  /// tests them. Throws std::logic_error for a name that is neither heading nor key.
  TakenProperties(std::initializer_list<std::string_view> names, std::initializer_list<Need> needs = {}) {
    add(names, needs);
  }

  /// Returns a copy with properties added or removed, and with further conditions.
  TakenProperties with(std::initializer_list<std::string_view> names, std::initializer_list<Need> needs = {}) const;

  bool has(const Property& property) const { return taken_.contains(&property); }
  /// Throws std::logic_error for an unknown key.
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

/// Returns the condition of commands whose pictures cannot end at their molecule: the size is not `auto`.
Need fixed_size_need();
/// Returns the condition of options for films: the output must be a film.
Need film_need();
/// Returns the condition of options that turn and move frames, which have no effect on areas and volumes. Each command
/// passes a `condition` of its own: it is met by the options that make this command write positions or directions.
/// ineffective_values() tests it.
Need superposition_need(Condition condition);

/// Returns a check that accepts any value. The name of the check is the list of words, where command_tree()
/// (command_tree.h) finds the proposals.
CLI::Validator proposes(const std::vector<std::string>& words);

/// Returns a check that accepts only these words.
CLI::Validator one_of(const std::vector<std::string>& words);

/// Adds options to a command. Name, heading, help, default, range and words of each option come from property_of(key),
/// which throws std::logic_error for an unknown key. Options appear in the help in the order in which they are added.
/// Exceptions of functions that are passed (CLI::ValidationError, SelectionError, RequestError) are not caught. The
/// command must outlive this object; targets and selections must exist until it has been parsed.
class PropertyOptions {
 public:
  explicit PropertyOptions(CLI::App& command) : command_(command) {}

  /// Adds a flag, a number within its range, a text or path, or several of them, which are stored unchanged. The types
  /// of targets are listed after the definition.
  template <typename Target>
  CLI::Option* add(std::string_view key, Target& target);

  /// Adds an option whose value is one of the property's words; `meanings` are in the order of the words.
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

  /// Adds an option whose text `parse` reads. For an invalid text `parse` throws one of the exceptions named above.
  CLI::Option* add_parsed(std::string_view key, const std::function<void(const std::string&)>& parse);
  /// Adds an option whose value is a selection of atoms. It throws SelectionError that names the option.
  CLI::Option* add_selection(std::string_view key, std::optional<Selection>& selection);
  /// Adds a flag that calls a function.
  CLI::Option* add_switch(std::string_view key, const std::function<void()>& turn_on);

 private:
  /// Returns the index of the text among the property's words. Throws CLI::ValidationError unless it is one of them.
  static std::size_t place_of_word(const Property& property, const std::string& text);
  CLI::Option* finish(const Property& property, CLI::Option* option) const;

  CLI::App& command_;
};

/// Returns the index of a word among a property's words. Throws UsageError if it is not one of them.
std::size_t place_of(const std::string& text, const Property& property);
/// Returns the meaning of a word. `meanings` must have one entry for each of the property's words, in their order; this
/// is not checked. An empty text has the first meaning. Throws UsageError for any other text.
template <typename Meaning>
Meaning meaning_of(const std::string& text, std::string_view key, std::initializer_list<Meaning> meanings) {
  return text.empty() ? *meanings.begin() : *(meanings.begin() + place_of(text, property_of(key)));
}

/// Returns the heading of the help with a property's option; empty if the help does not have the option.
std::string group_of(const Property& property);

/// Parses an expression that is the value of an option. Throws SelectionError that names the option.
Selection parse_selection_option(const std::string& option, const std::string& text);

/// Returns the path of the molecule, and an option for each value that differs from its default in Scene{}. The output
/// file is left out. If `path` is given, it returns the text that replaces the path of each file to read.
std::vector<std::string> scene_words(const Scene& scene,
                                     const std::function<std::string(const std::string& path)>& path = {});

/// Returns "meniscus", "render", scene_words(), and the output file if there is one.
std::vector<std::string> render_words(const Scene& scene);

/// Returns the words as one line for a shell, quoted if necessary.
std::string shell_line(std::span<const std::string> words);

/// Returns the page `meniscus help scenes`.
std::string scene_help();

/// Returns a JSON schema (draft 2020-12) of scene files, with a final newline: docs/reference/scene.schema.json.
std::string scene_schema();

}  // namespace meniscus
