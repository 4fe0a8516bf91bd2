// SPDX-License-Identifier: BSD-3-Clause
// Turns JSON values into texts and back, by the form of a property in scene files.
#include "core/scene/value_json.h"

#include <filesystem>
#include <system_error>

#include "core/base/error.h"
#include "core/base/system_file.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number()) throw RequestError("is neither a text nor a number");
  return value.dump();
}

std::string path_of(const Json& value) {
  if (!value.is_string() || value.get<std::string>().empty()) throw RequestError("is not a path");
  return value.get<std::string>();
}

/// As a number if it is written as JSON writes numbers.
Json number_or_text(const std::string& text) {
  const Json number = Json::parse(text, nullptr, false);
  return number.is_number() && number.dump() == text ? number : Json(text);
}

std::string seen_from(const std::string& folder, const std::string& path) {
  const fs::path given = path_of_text(path);
  if (folder.empty()) return text_of_path(given.filename());
  const fs::path whole = fs::absolute(given), base = fs::absolute(path_of_text(folder));
  std::error_code failed;
  // A link within the folder keeps its name: a scene may read no file outside of it. By names alone "link/.." would be
  // the folder of the link, so the file itself is asked.
  if (const fs::path within = whole.lexically_normal().lexically_relative(base.lexically_normal());
      !within.empty() && *within.begin() != ".." && fs::equivalent(base / within, whole, failed))
    return text_of_path(within);
  const fs::path seen = fs::proximate(whole, base, failed);
  return text_of_path(failed ? fs::absolute(given) : seen);
}

}  // namespace

std::vector<std::string> texts_of_json(const Property& property, const Json& value) {
  const SceneForm form = scene_form(property);
  switch (form) {
    case SceneForm::text_or_flag:
      if (value == false) return {};
      return {value == true ? std::string() : text_of(value)};
    case SceneForm::flag:
    case SceneForm::negated:
      if (!value.is_boolean()) throw RequestError("is neither true nor false");
      return {value.get<bool>() != property.has(negated) ? "true" : "false"};
    case SceneForm::text:
      return {text_of(value)};
    case SceneForm::path:
      return {path_of(value)};
    case SceneForm::camera:
      return {value.is_object() ? value.dump() : path_of(value)};
    case SceneForm::list:
    case SceneForm::paths:
      break;
  }
  std::vector<std::string> texts;
  for (const Json& one : value.is_array() ? value.get<std::vector<Json>>() : std::vector<Json>{value})
    texts.push_back(form == SceneForm::list ? text_of(one) : path_of(one));
  return texts;
}

Json json_of_texts(const Property& property, const std::vector<std::string>& texts, const std::string& folder) {
  Json list = Json::array();
  switch (scene_form(property)) {
    case SceneForm::flag:
      return true;
    case SceneForm::negated:
      return false;
    case SceneForm::text_or_flag:
      return texts.back() == "auto" ? Json(true) : number_or_text(texts.back());
    case SceneForm::text:
      return number_or_text(texts.back());
    case SceneForm::list:
      for (const std::string& text : texts) list.push_back(number_or_text(text));
      return list.size() == 1 ? list.front() : list;
    case SceneForm::path:
      return seen_from(folder, texts.back());
    case SceneForm::paths:
      for (const std::string& text : texts) list.push_back(seen_from(folder, text));
      return list;
    case SceneForm::camera:
      return texts.back().starts_with('{') ? Json::parse(texts.back(), nullptr, false)
                                           : Json(seen_from(folder, texts.back()));
  }
  return {};
}

}  // namespace meniscus
