// SPDX-License-Identifier: BSD-3-Clause
// Properties, each one thing that a user can choose, and their tables: options, help, scene keys, bundles and the
// preview follow from them.
//
// Options, their help, scene keys, bundles and the preview follow from it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// What a value is.
enum class ValueType {
  flag,      ///< true or false; an option without a value
  number,    ///< a finite number from `lowest` to `highest`
  count,     ///< a whole number in the same range
  word,      ///< one of `words`
  text,      ///< text with a syntax of its own: a selection, a colour, a length, a list of frames
  file,      ///< the path of a file to read
  new_file,  ///< the path of a file or folder to write
  camera     ///< a camera as JSON, or the path of a file that has one
};

/// Where a property may be set besides the command line, and what it means there; combined by |.
enum Trait : unsigned {
  in_scene = 1,         ///< a scene file has it, under `key`
  in_bundle = 2,        ///< the command of a farm bundle may have it: it writes no file and starts no program
  live = 4,             ///< the preview changes it while it runs
  repeatable = 8,       ///< may be given several times; a list in scene files
  value_optional = 16,  ///< the option may have no value; true in scene files
  needs_support = 32,   ///< a command without it would show something else, so it refuses a scene that sets it
  negated = 64,         ///< the scene key is false where the option is given
  rare = 128,           ///< few need it: the help has no words about its option; --set has its key
  of_objects = 256,     ///< each object beside the surface has its own
  of_surfaces = 512,    ///< each such object that is a surface has its own
  in_short_help = 1024  ///< --help shows its option even where a command has very many
};

/// The highest value of a property that has no upper limit.
inline constexpr double kUnlimited = 1e18;

/// One property: what tables are made of. Rows begin with one of the functions below, and say more by members that
/// return a changed copy. Defaults and help are for people; the structs that hold values have the defaults in force.
struct Property {
  ValueType type;
  std::string_view key;     ///< section and name, "look.silhouettes": unique; those of scene files where in_scene
  std::string_view option;  ///< as CLI11 takes it: "--silhouettes", "-o,--output", "FILE"
  std::string_view value;   ///< what the help calls the value: "WIDTH"; empty for flags
  std::string_view help;    ///< what it does, from a capital letter to no full stop; with_options() spells "@probe@"
  std::string_view heading{};
  unsigned traits = 0;
  double lowest = 0.0, highest = 0.0;  ///< of numbers, counts and lengths in pixels; equal: no range
  std::string_view words{};            ///< of a word all of them, else some that completion proposes: "ses|sas|vdw"
  std::string_view initial{};          ///< the default, which the help shows in brackets; empty: it shows none
  std::string_view label{};            ///< of its slider in the preview; empty: it has none
  double slider_end = 0.0;             ///< the largest value that the slider reaches
  std::string_view excluded{};         ///< keys that are not given beside it: "image.size|camera.from"
  std::string_view needed{};           ///< a key without which it means nothing

  /// A copy with another value of one member.
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
  /// Under a heading of the help, with the traits or-ed together.
  constexpr Property in(std::string_view title, unsigned all_traits = 0) const {
    return with<&Property::heading>(title).with<&Property::traits>(all_traits);
  }

  constexpr bool has(Trait trait) const { return (traits & trait) != 0; }
  constexpr bool has_range() const { return lowest < highest; }
  constexpr bool is_within(double number) const { return number >= lowest && number <= highest; }
  constexpr std::string_view section() const { return key.substr(0, key.find('.')); }
  constexpr std::string_view name() const { return key.substr(key.find('.') + 1); }
  /// The option's long name, "--output" of "-o,--output".
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

/// What the value of a property looks like in a scene file, and as words of a command line.
enum class SceneForm {
  text,          ///< a text or a number
  flag,          ///< true; false is the same as nothing
  negated,       ///< false gives the option, true is the same as nothing
  list,          ///< a text or a number, or a list of them: the option again and again
  path,          ///< a file, seen from the scene's folder
  paths,         ///< one, or a list of them
  text_or_flag,  ///< true gives the option without a value
  camera         ///< a path, or the camera itself as an object
};

SceneForm scene_form(const Property& property);

/// `words` parted at the bars.
std::vector<std::string> words_of(const Property& property);
/// Any such list.
std::vector<std::string> parted(std::string_view list);

/// The help with the default after it, in brackets.
std::string help_of(const Property& property);

/// The first sentence of such a text, up to a full stop or semicolon outside of parentheses, and then its brackets.
std::string first_sentence(std::string_view help);

/// All properties: sections in the order in which scene files are written, properties in that of the help. Tables that
/// a program adds come last.
std::span<const Property* const> properties();

/// Adds the properties of a program that no scene has. Such a constant stands in a file of the program, so that its
/// table is added before properties() is first called.
struct PropertyTable {
  explicit PropertyTable(std::span<const Property> table);
};

/// The property of this key. Throws std::logic_error where there is none: keys are written by programmers.
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
