// SPDX-License-Identifier: BSD-3-Clause
// Joins the tables of properties, finds properties by key, and derives their help, words and forms in scene files.
#include "core/properties/properties.h"

#include <algorithm>
#include <stdexcept>

#include "core/base/text.h"

namespace meniscus {

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

std::vector<std::string> words_of(const Property& property) { return parted(property.words); }

std::vector<std::string> parted(std::string_view left) {
  std::vector<std::string> words;
  while (!left.empty()) {
    const std::size_t bar = std::min(left.find('|'), left.size());
    words.emplace_back(left.substr(0, bar));
    left.remove_prefix(std::min(bar + 1, left.size()));
  }
  return words;
}

std::string help_of(const Property& property) {
  const std::string help(property.help), initial(property.initial);
  return with_options(initial.empty() ? help : help + " [" + initial + "]");
}

std::string first_sentence(std::string_view help) {
  std::string_view initial;
  if (const std::size_t bracket = help.rfind(" ["); help.ends_with(']') && bracket != help.npos) {
    initial = help.substr(bracket);
    help.remove_suffix(initial.size());
  }
  std::size_t end = 0;
  for (int depth = 0; end < help.size(); ++end) {
    if (help[end] == '(') ++depth;
    if (help[end] == ')') --depth;
    const std::string_view rest = help.substr(end);
    if (depth == 0 && (rest.starts_with("; ") || rest.starts_with(". "))) break;
  }
  return fmt::format("{}{}", help.substr(0, end), initial);
}

namespace {

std::vector<std::span<const Property>>& tables() {
  static std::vector<std::span<const Property>> all{
      molecule_properties(), frame_properties(),      surface_properties(), look_properties(),
      picture_properties(),  annotation_properties(), mesh_properties(),    report_properties()};
  return all;
}

}  // namespace

PropertyTable::PropertyTable(std::span<const Property> table) { tables().push_back(table); }

std::span<const Property* const> properties() {
  static const std::vector<const Property*> all = [] {
    std::vector<const Property*> joined;
    for (const std::span<const Property>& table : tables())
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

}  // namespace meniscus
