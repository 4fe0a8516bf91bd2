// SPDX-License-Identifier: BSD-3-Clause
// Writes storyboard files, and reads them and their scenes.
#include "app/options/storyboard_file.h"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kVersionKey = "meniscus_storyboard";
constexpr int kVersion = 1;

}  // namespace

std::string storyboard_text(const StoryboardFile& story) {
  Json json{{kVersionKey, kVersion}, {"hold", story.hold}, {"transition", story.transition}};
  json["scenes"] = Json::array();
  for (const std::string& scene : story.scenes) json["scenes"].push_back(Json::parse(scene));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<StoryboardFile> read_storyboard(const std::string& file) {
  constexpr std::size_t kLargest = std::size_t{64} << 20;  // bytes
  if (!file.ends_with(".json")) return {};
  const std::string text = read_text_file(file, kLargest).text;
  const Json json = is_nested_too_deep(text) ? Json() : Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains(kVersionKey)) return {};
  StoryboardFile story;
  try {
    if (json[kVersionKey] != kVersion) throw InputError(file, 0, "storyboard: another version of Meniscus wrote it");
    for (const Json& scene : json.at("scenes").get_ref<const Json::array_t&>()) story.scenes.push_back(scene.dump());
    story.hold = json.value("hold", std::vector<double>());
    story.transition = json.value("transition", std::vector<double>());
  } catch (const Json::exception&) {
    throw InputError(file, 0, "storyboard: \"scenes\" is not a list, or a time is not a number");
  }
  return story;
}

std::optional<std::string> scene_of_storyboard(const std::string& name) {
  const std::size_t sign = name.rfind(".json#");
  std::error_code ignored;
  if (sign == std::string::npos || std::filesystem::exists(name, ignored)) return {};
  const std::size_t end = sign + std::string_view(".json").size();
  const std::optional<StoryboardFile> story = read_storyboard(name.substr(0, end));
  double number = 0.0;
  if (!story || !parse_number(std::string_view(name).substr(end + 1), number)) return {};
  for (std::size_t n = 0; n < story->scenes.size(); ++n)
    if (number == static_cast<double>(n + 1)) return story->scenes[n];
  throw InputError(name, 0, "the storyboard has {} scenes", story->scenes.size());
}

}  // namespace meniscus
