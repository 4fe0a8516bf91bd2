// SPDX-License-Identifier: BSD-3-Clause
// Writes a scene as words by the table of properties.
#include "app/options/scene_words.h"

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/scene/scene_values.h"

namespace meniscus {

std::vector<std::string> scene_words(const Scene& scene,
                                     const std::function<std::string(const std::string& path)>& path) {
  const auto named = [&](const Property& property, const std::string& text) {
    const bool is_file =
        property.type == ValueType::file || (property.type == ValueType::camera && !text.starts_with('{'));
    return is_file && path ? path(text) : text;
  };
  std::vector<std::string> words{named(property_of("molecule.file"), scene.molecule.file)};
  for (const Property* property : properties()) {
    if (!is_scene_value(*property)) continue;
    if (property->key == "molecule.file" || property->key == "output.file") continue;
    const std::string option(property->long_option());
    for (const std::string& given : value_texts(scene, *property)) {
      const std::string text = named(*property, given);
      if (property->type == ValueType::flag) {
        words.push_back(option);
      } else if (text.starts_with('-') || text.empty()) {  // which would be taken for an option, or for none
        words.push_back(fmt::format("{}={}", option, text));
      } else {
        words.push_back(option);
        words.push_back(text);
      }
    }
  }
  return words;
}

std::vector<std::string> render_words(const Scene& scene) {
  std::vector<std::string> words{"meniscus", "render"};
  const std::vector<std::string> values = scene_words(scene);
  words.insert(words.end(), values.begin(), values.end());
  if (!scene.output.empty()) words.insert(words.end(), {"-o", scene.output});
  return words;
}

std::string shell_line(std::span<const std::string> words) {
  std::string line;
  for (const std::string& word : words) {
    const bool plain =
        word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./:,+=") ==
            std::string::npos &&
        !word.empty();
    line += (line.empty() ? "" : " ") + (plain ? word : escaped(shell_word(word)));
  }
  return line;
}

}  // namespace meniscus
