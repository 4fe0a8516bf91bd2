// SPDX-License-Identifier: BSD-3-Clause
// Properties and their tables. A property is one thing that a user can choose; options, help, scene keys, bundles and
// the preview follow from the tables.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

enum class ValueType {
  flag,      ///< true or false; an option without a value
  number,    ///< a finite number from `lowest` to `highest`
  count,     ///< a whole number from `lowest` to `highest`
  word,      ///< one of `words`
  text,      ///< text with its own syntax: a selection, a colour, a length, a list of frames
  file,      ///< the path of a file to read
  new_file,  ///< the path of a file or folder to write
  camera     ///< a camera as JSON, or the path of a file that has one
};

/// The places, other than the command line, where a property may be set, and its meaning there; combined by |.
enum Trait : unsigned {
  in_scene = 1,         ///< scene files have it, under `key`
  in_bundle = 2,        ///< the command of a farm bundle may have it: it writes no file and starts no program
  live = 4,             ///< the preview changes it while it runs
  repeatable = 8,       ///< may be given several times; scene files have a list
  value_optional = 16,  ///< the option may have no value; scene files have true instead
  needs_support = 32,   ///< a command without this option would show something else, so it refuses scenes that set it
  negated = 64,         ///< scene files have false if the option is given
  rare = 128,           ///< few users need it: the help does not describe its option; --set accepts its key
  of_objects = 256,     ///< each object drawn in addition to the surface has its own value
  of_surfaces = 512,    ///< each such object that is a surface has its own value
  in_short_help = 1024  ///< --help shows its option even for commands with very many
};

/// The highest value of a property that has no upper limit.
inline constexpr double kUnlimited = 1e18;

/// One property: a row of a table. A row begins with one of the functions below, and adds to it by members that return
/// a changed copy. Defaults and help are only shown to users; the structs that hold values define the defaults.
struct Property {
  ValueType type;
  std::string_view key;     ///< section and name, "look.silhouettes": unique; with in_scene, also in scene files
  std::string_view option;  ///< names on the command line, in CLI11's form
  std::string_view value;   ///< the name of the value in the help: "WIDTH"; empty for flags
  std::string_view help;    ///< begins with a capital letter, ends without a full stop; with_options() spells "@probe@"
  std::string_view heading{};
  unsigned traits = 0;
  double lowest = 0.0, highest = 0.0;  ///< range of numbers, counts and lengths in pixels; equal: no range
  std::string_view words{};     ///< all words of a word property, else words that completion proposes: "ses|sas|vdw"
  std::string_view initial{};   ///< the default, which the help shows in brackets; empty: not shown
  std::string_view label{};     ///< label of its slider in the preview; empty: it has no slider
  double slider_end = 0.0;      ///< the largest value that the slider reaches
  std::string_view excluded{};  ///< keys that must not be given with it: "image.size|camera.from"
  std::string_view needed{};    ///< a key that must be given with it

  /// Returns a copy with another value of one member.
  template <auto member>
  constexpr Property with(auto other) const {
    Property changed = *this;
    changed.*member = other;
    return changed;
  }
  constexpr Property from(double least, double most) const {
    return with<&Property::lowest>(least).with<&Property::highest>(most);
  }
  constexpr Property one_of(std::string_view all) const { return with<&Property::words>(all); }
  constexpr Property proposes(std::string_view some) const { return one_of(some); }
  constexpr Property initially(std::string_view shown) const { return with<&Property::initial>(shown); }
  constexpr Property excludes(std::string_view keys) const { return with<&Property::excluded>(keys); }
  constexpr Property needs(std::string_view other_key) const { return with<&Property::needed>(other_key); }
  constexpr Property slider(std::string_view name, double end) const {
    return with<&Property::label>(name).with<&Property::slider_end>(end);
  }
  /// Returns a copy under a heading of the help, with the traits combined by |.
  constexpr Property in(std::string_view title, unsigned all_traits = 0) const {
    return with<&Property::heading>(title).with<&Property::traits>(all_traits);
  }

  constexpr bool has(Trait trait) const { return (traits & trait) != 0; }
  constexpr bool has_range() const { return lowest < highest; }
  constexpr bool is_within(double number) const { return number >= lowest && number <= highest; }
  constexpr std::string_view section() const { return key.substr(0, key.find('.')); }
  constexpr std::string_view name() const { return key.substr(key.find('.') + 1); }
  /// Returns the option's long name, "--output" of "-o,--output".
  constexpr std::string_view long_option() const { return option.substr(option.rfind(',') + 1); }
};

constexpr Property flag(std::string_view key, std::string_view option, std::string_view help) {
  return {ValueType::flag, key, option, "", help};
}
constexpr Property number(std::string_view key, std::string_view option, std::string_view value,
                          std::string_view help) {
  return {ValueType::number, key, option, value, help};
}
constexpr Property count(std::string_view key, std::string_view option, std::string_view value, std::string_view help) {
  return {ValueType::count, key, option, value, help};
}
constexpr Property word(std::string_view key, std::string_view option, std::string_view value, std::string_view help) {
  return {ValueType::word, key, option, value, help};
}
constexpr Property text(std::string_view key, std::string_view option, std::string_view value, std::string_view help) {
  return {ValueType::text, key, option, value, help};
}
constexpr Property file(std::string_view key, std::string_view option, std::string_view value, std::string_view help) {
  return {ValueType::file, key, option, value, help};
}
constexpr Property new_file(std::string_view key, std::string_view option, std::string_view value,
                            std::string_view help) {
  return {ValueType::new_file, key, option, value, help};
}
constexpr Property camera(std::string_view key, std::string_view option, std::string_view value,
                          std::string_view help) {
  return {ValueType::camera, key, option, value, help};
}

/// The form of a property's value in a scene file, and its words on a command line.
enum class SceneForm {
  text,          ///< a text or a number
  flag,          ///< true; false equals a missing key
  negated,       ///< false gives the option; true equals a missing key
  list,          ///< a text or a number, or a list of them: one option for each
  path,          ///< a file, relative to the scene's folder
  paths,         ///< one path, or a list of paths
  text_or_flag,  ///< true gives the option without a value
  camera         ///< a path, or the camera itself as an object
};

SceneForm scene_form(const Property& property);

/// Returns the words of a property, separated by bars in `words`.
std::vector<std::string> words_of(const Property& property);
/// Returns the parts of any list that is separated by bars.
std::vector<std::string> parted(std::string_view list);

/// Returns the help, followed by the default in brackets.
std::string help_of(const Property& property);

/// Returns the first sentence of a help text, up to a full stop or semicolon outside of parentheses, with its brackets.
std::string first_sentence(std::string_view help);

/// Returns all properties: sections in the order of scene files, the properties of a section in the order of the help.
/// Tables that a program adds come last.
std::span<const Property* const> properties();

/// Adds the properties of a program that scenes do not have. It must be a constant in a file of the program, so that
/// its table is added before the first call of properties().
struct PropertyTable {
  explicit PropertyTable(std::span<const Property> table);
};

/// Returns the property of this key. Throws std::logic_error if there is none, because keys are written by programmers.
const Property& property_of(std::string_view key);

std::span<const Property> molecule_properties();
std::span<const Property> frame_properties();
std::span<const Property> surface_properties();
std::span<const Property> look_properties();
std::span<const Property> picture_properties();
std::span<const Property> annotation_properties();
std::span<const Property> mesh_properties();
std::span<const Property> report_properties();

}  // namespace meniscus
