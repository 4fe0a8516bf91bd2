// SPDX-License-Identifier: BSD-3-Clause
// Finds values by their keys, and completes those that depend on each other.
#include "core/scene/scene_values.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/scene/scene_lengths.h"
#include "core/scene/scene_value.h"

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
  if (!property.has_range()) throw RequestError(fmt::format("{} is not a {}", in_quotes(text), kind));
  if (property.highest >= kUnlimited)
    throw RequestError(fmt::format("{} is not a {} of at least {}", in_quotes(text), kind, property.lowest));
  throw RequestError(
      fmt::format("{} is not a {} from {} to {}", in_quotes(text), kind, property.lowest, property.highest));
}

std::size_t place_of_word(const std::vector<std::string>& words, const std::string& text) {
  const auto word = std::ranges::find(words, text);
  if (word == words.end())
    throw RequestError(fmt::format("{} is not one of {}", in_quotes(text), fmt::join(words, ", ")));
  return static_cast<std::size_t>(word - words.begin());
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

// Values that depend on each other.

void complete_lengths(Scene& scene) {
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
}

void complete_colors(MoleculeRequest& molecule) {
  using By = ColorScheme::By;
  ColorScheme& color = molecule.color;
  const bool has_numbers = !molecule.number_file.empty(), has_volume = !molecule.volume_file.empty();
  if (has_numbers && !molecule.color_named && !color.uses_file()) color.by = By::file;
  if (has_volume) {
    if (molecule.color_named)
      throw ValueError("surface.color_map_file", "is itself a --color; leave the other one out, but EXPR=COLOR");
    if (!color.range) throw ValueError("surface.color_map_file", "needs --color-range LO:HI, such as -5:5 for kT/e");
    color.by = By::volume;
  }
  if (color.uses_file() && !has_numbers) throw ValueError("surface.color", "file needs --color-by-file FILE");
  if (has_numbers && !color.uses_file())
    throw ValueError("surface.color_by_file", "is itself a --color; leave the other one out");
  if (color.by == By::kind && !color.rules.empty())
    throw ValueError("surface.color", "kind colours patches, EXPR=COLOR atoms; choose another scheme beside it");
  if (color.uses_scale()) return;
  const char* const key = !molecule.map_file.empty() ? "surface.map_file"
                          : color.map                ? "surface.map"
                          : color.range              ? "surface.color_range"
                          : color.missing            ? "surface.missing_color"
                                                     : nullptr;
  if (key)
    throw ValueError(
        key,
        "is for colours by a number: bfactor, occupancy, charge, hydrophobicity, index, radial, file, a volume map");
}

void complete_interface(Scene& scene) {
  MoleculeRequest& molecule = scene.molecule;
  if (!molecule.interface) return;
  if (!molecule.color_named && molecule.color.rules.empty() && molecule.number_file.empty())
    molecule.color.by = ColorScheme::By::buried;
  if (!scene.picture.direction && scene.picture.camera_file.empty())
    scene.picture.direction = parse_view_direction("z");
}

}  // namespace

bool operator==(const Scene& one, const Scene& other) {
  return std::ranges::all_of(properties(), [&](const Property* property) {
    return !property->has(in_scene) || value_texts(one, *property) == value_texts(other, *property);
  });
}

bool is_scene_value(const Property& property) { return value_of(property.key) != nullptr; }

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
  complete_interface(scene);
  complete_colors(scene.molecule);
}

Scene readied(Scene scene) {
  MoleculeRequest& molecule = scene.molecule;
  scene.figure.ask_for(molecule.reading);
  if (!molecule.interface) return scene;
  if (!molecule.reading.shown.empty())
    throw ValueError("surface.interface", "moves the atoms of both sides; nothing can stand beside them");
  std::string atoms = "(" + molecule.interface->left.text() + ") or (" + molecule.interface->right.text() + ")";
  if (molecule.reading.selection) atoms = "(" + molecule.reading.selection->text() + ") and (" + atoms + ")";
  molecule.reading.selection = parse_selection(atoms);
  molecule.reading.sides = {molecule.interface->left, molecule.interface->right};
  return scene;
}

}  // namespace meniscus
