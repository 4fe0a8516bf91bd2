// SPDX-License-Identifier: BSD-3-Clause
// Rows that bind the values of a scene to its members: each reads the member of a property from text and writes it as
// text; and lengths, in pixels or in millimetres, inches and points on paper.
#pragma once

#include <concepts>
#include <type_traits>

#include "core/base/error.h"
#include "core/properties/properties.h"
#include "core/scene/scene.h"

namespace meniscus::scene_values {

using Texts = std::span<const std::string>;
using Written = std::vector<std::string>;

/// One property and its member. read() throws RequestError, SelectionError. reset() gives the member the value of
/// Scene{}; it is missing for some values that no preview changes.
struct SceneValue {
  std::string_view key;
  void (*read)(const Property& property, Texts texts, Scene& scene);
  Written (*write)(const Property& property, const Scene& scene);
  void (*reset)(const Property& property, Scene& scene) = nullptr;
};

/// Sets a value from texts in the form of set_value() or, without texts, to the value of Scene{}. The property must be
/// one that previews change (Trait::live). Throws like set_value().
void replace_value(Scene& scene, const Property& property, Texts texts);

/// Return the rows of one subject.
std::span<const SceneValue> molecule_values();
std::span<const SceneValue> surface_values();
std::span<const SceneValue> picture_values();

/// Completes the molecule, its colours and its interface: a part of complete(). Throws ValueError.
void complete_molecule(Scene& scene);

/// Returns the scene with all defaults.
const Scene& usual_scene();

/// Parses a number in the range of its property. Throws RequestError.
double number_in_range(const Property& property, const std::string& text);
/// Returns the place of the text among the words. Throws RequestError if it is not one of them.
std::size_t place_of_word(const std::vector<std::string>& words, const std::string& text);

// Values of common types are parsed from the last of several texts, and written unless they have their defaults.

template <typename Number>
requires std::is_arithmetic_v<Number>
void read(const Property& property, Texts texts, Number& number) {
  if constexpr (std::same_as<Number, bool>)
    number = texts.back() != "false";
  else
    number = static_cast<Number>(number_in_range(property, texts.back()));
}
inline void read(const Property&, Texts texts, std::string& text) { text = texts.back(); }
inline void read(const Property&, Texts texts, std::vector<std::string>& all) {
  all.insert(all.end(), texts.begin(), texts.end());
}
inline void read(const Property&, Texts texts, std::optional<Selection>& atoms) {
  atoms = parse_selection(texts.back());
}
template <typename Value>
void read(const Property& property, Texts texts, std::optional<Value>& value) {
  read(property, texts, value.emplace());
}

template <typename Number>
requires std::is_arithmetic_v<Number> Written written(const Number& number, const Number& usual) {
  if (number == usual) return {};
  return {fmt::format("{}", number)};
}
inline Written written(const std::string& text, const std::string& usual) {
  if (text == usual) return {};
  return {text};
}
inline Written written(const std::vector<std::string>& all, const std::vector<std::string>&) { return all; }
inline Written written(const std::optional<Selection>& atoms, const std::optional<Selection>&) {
  if (!atoms) return {};
  return {atoms->text()};
}
template <typename Value>
Written written(const std::optional<Value>& value, const std::optional<Value>&) {
  if (!value) return {};
  if constexpr (std::is_arithmetic_v<Value>)
    return {fmt::format("{}", *value)};
  else
    return {*value};
}

/// Gives a member the value of Scene{}.
template <typename Member>
void reset_member(const Property&, Scene& scene) {
  *Member{}(scene) = *Member{}(usual_scene());
}

/// Returns the row of a value that is read by its type. Member: a stateless function that returns the address of the
/// value in a scene.
template <typename Member>
constexpr SceneValue plain(std::string_view key, Member) {
  return {key, [](const Property& property, Texts texts, Scene& scene) { read(property, texts, *Member{}(scene)); },
          [](const Property&, const Scene& scene) { return written(*Member{}(scene), *Member{}(usual_scene())); },
          reset_member<Member>};
}

/// Returns the row of a value that is one of the property's words. meanings: one per word, in the same order. Scene
/// files of version 0.1.0 have the number of the enumerator instead of the word.
template <auto... meanings, typename Member>
constexpr SceneValue worded(std::string_view key, Member) {
  using Value = std::common_type_t<decltype(meanings)...>;
  constexpr auto read_word = [](const Property& property, Texts texts, Scene& scene) {
    constexpr Value kMeanings[] = {meanings...};
    const std::string& text = texts.back();
    const auto* const numbered = std::ranges::find_if(
        kMeanings, [&](Value meaning) { return text == fmt::format("{}", static_cast<int>(meaning)); });
    *Member{}(scene) = numbered != std::end(kMeanings) ? *numbered : kMeanings[place_of_word(words_of(property), text)];
  };
  constexpr auto write_word = [](const Property& property, const Scene& scene) -> Written {
    constexpr Value kMeanings[] = {meanings...};
    const std::optional<Value> value = *Member{}(scene);
    if (value == *Member{}(usual_scene())) return {};
    return {words_of(property)[static_cast<std::size_t>(std::ranges::find(kMeanings, *value) - kMeanings)]};
  };
  return {key, read_word, write_word, reset_member<Member>};
}

/// Returns the row of a value that parse() reads and text() writes. parse() reads one text, or each text of a list.
template <auto parse, auto text, typename Member>
constexpr SceneValue coded(std::string_view key, Member) {
  constexpr auto read_text = [](const Property&, Texts texts, Scene& scene) {
    auto& value = *Member{}(scene);
    if constexpr (requires { value.push_back(parse(texts.back())); })
      for (const std::string& one : texts) value.push_back(parse(one));
    else
      value = parse(texts.back());
  };
  constexpr auto write_text = [](const Property&, const Scene& scene) -> Written {
    const auto& value = *Member{}(scene);
    Written texts;
    if constexpr (requires { value.size(); })
      for (const auto& one : value) texts.push_back(text(one));
    else if constexpr (requires { value.has_value(); })
      return value ? Written{std::string(text(*value))} : Written();
    else
      return written(std::string(text(value)), std::string(text(*Member{}(usual_scene()))));
    return texts;
  };
  return {key, read_text, write_text, reset_member<Member>};
}

/// Parses a colour. Returns nothing for the word `none`. Throws RequestError.
std::optional<glm::vec3> parse_color_or(std::string_view none, const std::string& text);
inline std::optional<glm::vec3> parse_any_color(const std::string& text) { return parse_color_or("", text); }

inline constexpr int kLargestSide = 65535;  // pixels; PNG and EXR readers of other programs accept no more
/// The default resolution of lengths on paper, dots per inch.
inline constexpr double kUsualResolution = 300.0;

/// A length in pixels or on paper.
struct Length {
  double value = 0.0;
  double per_inch = 0.0;  ///< units per inch; 0: pixels

  /// Returns the length in pixels. A resolution of 0 is not known; kUsualResolution is then used.
  double pixels(double dots_per_inch) const;
};

/// Parses "85mm", "8.5cm", "3.5in", "8pt", "1000px" or "1000". Throws RequestError.
Length parse_length(const std::string& text);

/// Returns a side of a picture in pixels. Throws RequestError if it has no pixel or too many, provided that the
/// resolution is known.
int side_in_pixels(const std::string& text, double dots_per_inch);
/// Returns a length of lines or letters in pixels. what: the subject of the message, "a line has". Throws RequestError
/// if it is outside of the property's range, provided that the resolution is known.
double pixels_in_range(const Property& property, const std::string& text, double dots_per_inch, const char* what);

/// Keeps the text of a length on paper in the scene.
void keep_length(Scene& scene, std::string_view key, const std::string& text);

/// Converts pixels to the type of a width: widths of lines may be fractions, heights of letters are whole numbers.
template <typename Number>
Number as_width(double pixels) {
  return static_cast<Number>(std::is_integral_v<Number> ? std::round(pixels) : pixels);
}

template <typename Number>
void read_length(const Property& property, Texts texts, Scene& scene, std::optional<Number>& width, const char* what) {
  width = as_width<Number>(pixels_in_range(property, texts.back(), scene.picture.dots_per_inch, what));
  keep_length(scene, property.key, texts.back());
}

/// Returns the text of a width. A kept length on paper is used as long as it still equals the width.
template <typename Number>
Written written_length(const Property& property, const Scene& scene, const std::optional<Number>& width) {
  const auto length = scene.lengths.find(property.key);
  if (width && length != scene.lengths.end() &&
      as_width<Number>(parse_length(length->second).pixels(scene.picture.dots_per_inch)) == *width)
    return {length->second};
  return written(width, {});
}

/// Gives all lengths on paper their values in pixels. Throws ValueError for lengths that the properties cannot have.
void complete_lengths(Scene& scene);

/// Returns the size in pixels that lengths of sides give. With a single side, the picture has the default aspect ratio.
glm::ivec2 size_by_lengths(const Scene& scene);
/// True if the size of the picture is size_by_lengths(), except for a height that follows from the molecule.
bool has_lengths_of_sides(const Scene& scene);

}  // namespace meniscus::scene_values
