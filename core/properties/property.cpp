// SPDX-License-Identifier: BSD-3-Clause
// Joins the tables of properties into one, and finds a property by its key.
#include "core/properties/property.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "core/properties/tables.h"

namespace meniscus {

std::span<const Property* const> properties() {
  static const std::vector<const Property*> all = [] {
    std::vector<const Property*> joined;
    for (const auto& table :
         {molecule_properties(), frame_properties(), surface_properties(), look_properties(), picture_properties(),
          annotation_properties(), mesh_properties(), report_properties(), farm_properties()})
      for (const Property& property : table) joined.push_back(&property);
    return joined;
  }();
  return all;
}

const Property& property_of(std::string_view key) {
  const auto found = std::ranges::find(properties(), key, &Property::key);
  if (found == properties().end()) throw std::logic_error(fmt::format("there is no property {}", key));
  return **found;
}

SceneForm scene_form(const Property& property) {
  const bool many = property.has(repeatable);
  switch (property.type) {
    case ValueType::flag:
      return property.has(negated) ? SceneForm::negated : SceneForm::flag;
    case ValueType::file:
    case ValueType::new_file:
      return many ? SceneForm::paths : SceneForm::path;
    case ValueType::camera:
      return SceneForm::camera;
    default:
      return many ? SceneForm::list : property.has(value_optional) ? SceneForm::text_or_flag : SceneForm::text;
  }
}

std::vector<std::string> words_of(const Property& property) {
  std::vector<std::string> words;
  std::string_view left = property.words;
  while (!left.empty()) {
    const std::size_t bar = std::min(left.find('|'), left.size());
    words.emplace_back(left.substr(0, bar));
    left.remove_prefix(std::min(bar + 1, left.size()));
  }
  return words;
}

std::string help_of(const Property& property) {
  return property.initial.empty() ? std::string(property.help)
                                  : fmt::format("{} [{}]", property.help, property.initial);
}

}  // namespace meniscus
