// SPDX-License-Identifier: BSD-3-Clause
// Finds values by their keys, parses lengths, and completes values that depend on each other.
#include "core/scene/scene_values.h"

#include <cctype>

#include <fmt/ranges.h>

#include "core/scene/scene_value.h"

namespace meniscus::scene_values {
namespace {

constexpr double kMillimetersPerInch = 25.4, kPointsPerInch = 72.0;

/// True if the length is known in pixels: a length on paper needs the resolution.
bool is_known_in_pixels(const Length& length, double dots_per_inch) {
  return length.per_inch == 0.0 || dots_per_inch > 0.0;
}

}  // namespace

double Length::pixels(double dots_per_inch) const {
  if (per_inch == 0.0) return value;
  return value * (dots_per_inch == 0.0 ? kUsualResolution : dots_per_inch) / per_inch;
}

Length parse_length(const std::string& text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789.+-eE"), text.size());
  const std::string unit = text.substr(end);
  const std::map<std::string, double> per_inch{
      {"in", 1.0}, {"cm", kMillimetersPerInch / 10.0}, {"mm", kMillimetersPerInch}, {"pt", kPointsPerInch}};
  const auto known = per_inch.find(unit);
  Length length;
  if (!parse_number(text.substr(0, end), length.value) || (known == per_inch.end() && !unit.empty() && unit != "px"))
    throw RequestError(in_quotes(text) + " is not a length such as 85mm, 8.5cm, 3.5in, 8pt or 1000px");
  if (known != per_inch.end()) length.per_inch = known->second;
  return length;
}

int side_in_pixels(const std::string& text, double dots_per_inch) {
  const Length length = parse_length(text);
  const double pixels = std::round(length.pixels(dots_per_inch));
  if (is_known_in_pixels(length, dots_per_inch) && !(pixels >= 1.0 && pixels <= kLargestSide))
    throw RequestError("{} makes {:.0f} pixels; a side has 1 to {}", in_quotes(text), pixels, kLargestSide);
  return static_cast<int>(pixels);
}

double pixels_in_range(const Property& property, const std::string& text, double dots_per_inch, const char* what) {
  const Length length = parse_length(text);
  const double pixels = length.pixels(dots_per_inch);
  if (!is_known_in_pixels(length, dots_per_inch) || property.is_within(pixels)) return pixels;
  throw RequestError("{} makes {:.4g} pixels; {} {} to {}", in_quotes(text), pixels, what, property.lowest,
                     property.highest);
}

void keep_length(Scene& scene, std::string_view key, const std::string& text) {
  scene.lengths.erase(std::string(key));
  if (parse_length(text).per_inch != 0.0) scene.lengths[std::string(key)] = text;
}

glm::ivec2 size_by_lengths(const Scene& scene) {
  const double shape = usual_scene().picture.aspect(), dots = scene.picture.dots_per_inch;
  const auto wide = scene.lengths.find("image.width"), high = scene.lengths.find("image.height");
  glm::ivec2 size = scene.picture.size();
  if (wide != scene.lengths.end()) {
    size.x = side_in_pixels(wide->second, dots);
    size.y = std::clamp(static_cast<int>(std::lround(size.x / shape)), 1, kLargestSide);
  }
  if (high != scene.lengths.end()) {
    size.y = side_in_pixels(high->second, dots);
    if (wide == scene.lengths.end())
      size.x = std::clamp(static_cast<int>(std::lround(size.y * shape)), 1, kLargestSide);
  }
  return size;
}

bool has_lengths_of_sides(const Scene& scene) {
  return (scene.lengths.contains("image.width") || scene.lengths.contains("image.height")) &&
         (scene.picture.fits || size_by_lengths(scene) == scene.picture.size());
}

}  // namespace meniscus::scene_values

namespace meniscus {
namespace scene_values {

const Scene& usual_scene() {
  static const Scene usual;
  return usual;
}

double number_in_range(const Property& property, const std::string& text) {
  double number = 0.0;
  std::int64_t whole = 0;
  const bool is_count = property.type == ValueType::count;
  const bool is_read = is_count ? parse_whole_number(text, whole) : parse_number(text, number);
  if (is_count) number = static_cast<double>(whole);
  if (is_read && (!property.has_range() || property.is_within(number))) return number;
  const char* const kind = is_count ? "whole number" : "number";
  if (!property.has_range()) throw RequestError("{} is not a {}", in_quotes(text), kind);
  if (property.highest >= kUnlimited)
    throw RequestError("{} is not a {} of at least {}", in_quotes(text), kind, property.lowest);
  throw RequestError("{} is not a {} from {} to {}", in_quotes(text), kind, property.lowest, property.highest);
}

std::size_t place_of_word(const std::vector<std::string>& words, const std::string& text) {
  const auto word = std::ranges::find(words, text);
  if (word == words.end()) throw RequestError("{} is not one of {}", in_quotes(text), fmt::join(words, ", "));
  return static_cast<std::size_t>(word - words.begin());
}

std::optional<glm::vec3> parse_color_or(std::string_view none, const std::string& text) {
  if (!none.empty() && text == none) return {};
  if (const std::optional<glm::vec3> color = parse_color(text)) return color;
  const std::string what = none.empty() ? "is not" : fmt::format("is neither {} nor", none);
  throw RequestError("{} {} a colour: give a name such as red, or #rrggbb", in_quotes(text), what);
}

}  // namespace scene_values

namespace {

using namespace scene_values;

const SceneValue* value_of(std::string_view key) {
  for (const std::span<const SceneValue> rows : {molecule_values(), surface_values(), picture_values()}) {
    const auto found = std::ranges::find(rows, key, &SceneValue::key);
    if (found != rows.end()) return &*found;
  }
  return nullptr;
}

}  // namespace

void scene_values::replace_value(Scene& scene, const Property& property, Texts texts) {
  value_of(property.key)->reset(property, scene);
  if (!texts.empty()) set_value(scene, property, texts);
}

void scene_values::complete_lengths(Scene& scene) {
  if (scene.picture.dots_per_inch == 0.0 && std::ranges::any_of(scene.lengths, [](const auto& length) {
        return parse_length(length.second).per_inch != 0.0;
      }))
    scene.picture.dots_per_inch = kUsualResolution;
  const std::map<std::string, std::string, std::less<>> lengths = scene.lengths;
  for (const auto& [key, text] : lengths) {
    if (key == "image.width" || key == "image.height") continue;
    try {
      set_value(scene, property_of(key), std::array{text});
    } catch (const RequestError& error) {
      throw ValueError(key, error.what());
    }
  }
  const glm::ivec2 size = size_by_lengths(scene);
  scene.picture.width = size.x;
  scene.picture.height = size.y;
  constexpr double kBorder = 2.0 / 25.4;  // inches: 2 mm
  // In a tiny picture a twentieth of its side is enough.
  scene.annotations.letters.border =
      std::min(static_cast<int>(std::lround(kBorder * scene.picture.dots_per_inch)), std::min(size.x, size.y) / 20);
}

bool operator==(const Scene& one, const Scene& other) {
  return std::ranges::all_of(properties(), [&](const Property* property) {
    return !property->has(in_scene) || !is_scene_value(*property) ||
           value_texts(one, *property) == value_texts(other, *property);
  });
}

bool is_scene_value(const Property& property) { return value_of(property.key) != nullptr; }

std::string value_name(const Property& property) {
  std::string_view option = property.long_option();
  option.remove_prefix(std::min(option.find_first_not_of('-'), option.size()));
  std::string name;
  for (const char letter : option)
    name += letter == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return name;
}

const Property& scene_property(std::string_view name) {
  std::vector<std::string> names;
  for (const Property* property : properties()) {
    if (!property->has(in_scene) && !is_scene_value(*property)) continue;
    if (names.emplace_back(value_name(*property)) != name && property->key != name) continue;
    if (is_scene_value(*property)) return *property;
    throw RequestError(
        "needs molecules; scenes of this build have none, because it was made without gemmi, nlohmann_json or "
        "FreeType");
  }
  const std::string_view nearest = nearest_word(name, std::vector<std::string_view>(names.begin(), names.end()));
  throw RequestError("is not a value of a scene{}", nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest));
}

void set_value(Scene& scene, const Property& property, std::span<const std::string> texts) {
  try {
    value_of(property.key)->read(property, texts, scene);
  } catch (const RequestError& error) {
    throw ValueError(property.key, error.what());
  }
}

std::vector<std::string> value_texts(const Scene& scene, const Property& property) {
  return value_of(property.key)->write(property, scene);
}

void complete(Scene& scene) {
  complete_lengths(scene);
  complete_molecule(scene);
}

}  // namespace meniscus

#ifndef MENISCUS_WITH_SCENES

// Builds without gemmi, nlohmann_json or FreeType have no molecules: a scene has only its look and its picture.
namespace meniscus {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw RequestError("this build has no {}: it was made without gemmi, nlohmann_json or FreeType", what);
}

}  // namespace

Selection parse_selection(std::string_view) { refuse("selections"); }
LabelRequest parse_label(std::string_view) { refuse("labels"); }
void parse_scale_bar(const std::string&, AnnotationRequest&) { refuse("scale bars"); }

std::optional<ViewDirection> parse_view_direction(std::string_view) { refuse("sides of molecules"); }
std::vector<std::string> view_direction_words() { return {}; }
std::optional<Turn> parse_turn(std::string_view) { refuse("turns of molecules"); }

bool ColorScheme::uses_scale() const { return has_scale(); }  // rules are not checked

namespace scene_values {

std::span<const SceneValue> molecule_values() { return {}; }
std::span<const SceneValue> surface_values() { return {}; }
void complete_molecule(Scene& scene) {
  if (scene.look.preset > LookPreset::classic) refuse("looks of molecules");
}

}  // namespace scene_values
}  // namespace meniscus

#endif
