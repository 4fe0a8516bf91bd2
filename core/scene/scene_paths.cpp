// SPDX-License-Identifier: BSD-3-Clause
// Lets scenes name only files that their user knows of.
#include "core/scene/scene_json.h"

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/scene/scene_values.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& file, const std::string& place, const std::string& what) {
  throw InputError(file, 0, "scene: {} {}", place, what);
}

}  // namespace

bool SceneTrust::has(const std::string& path) const {
  std::error_code ignored;
  const auto is_it = [&](const std::string& word) {
    return fs::equivalent(path_of_text(word), path_of_text(path), ignored);
  };
  return std::ranges::any_of(typed, is_it) || std::ranges::any_of(named, is_it);
}

std::string SceneTrust::path(const Property& property, const std::string& text, const std::string& place) const {
  const fs::path given = path_of_text(text);
  if (text == "-") fail(file, place, "is \"-\", standard input or output; a scene names files");
  std::error_code ignored;
  std::string path = text_of_path(given.is_absolute() ? given : path_of_text(file).parent_path() / given);
  // A picture in a folder of its own names its molecule as its command did: relative to the working folder.
  const bool reads = property.type != ValueType::new_file;
  if (reads && !fs::exists(path_of_text(path), ignored) && fs::exists(given, ignored)) path = text;
  // Pictures and pages have the names of files without folders.
  const auto has_name = [&](const std::string& word) { return path_of_text(word).filename() == given; };
  if (const auto word = std::ranges::find_if(named, has_name);
      reads && word != named.end() && !fs::exists(path_of_text(path), ignored))
    return *word;
  if (is_whole) return path;
  if (reads) {
    const bool leads_out = given.is_absolute() || std::ranges::find(given, fs::path("..")) != given.end();
    if (leads_out && !has(path))
      fail(file, place, fmt::format("is {}, outside of the scene's folder; {}", in_quotes(text), advice));
    return path;
  }
  const std::string own_advice = message("name it by {} FILE, or add @trust-scene@ if the scene is yours",
                                         property.key == "output.file" ? "-o" : std::string(property.long_option()));
  if (given != given.filename())
    fail(file, place,
         fmt::format("is {}; a scene cannot choose the folder of its picture: {}", in_quotes(text), own_advice));
  if (text.starts_with('-') || text.starts_with('.') || escaped(text) != text)
    fail(file, place,
         fmt::format("is {}; the name of an output must not begin with - or a dot, or contain control characters: {}",
                     in_quotes(text), own_advice));
  if (replaces && fs::exists(fs::symlink_status(path_of_text(path), ignored)))
    fail(file, place,
         message("is {}, which exists already; @force@ replaces what is named on the command line: {}", in_quotes(text),
                 own_advice));
  return path;
}

std::string scene_fault(const Scene& scene) {
  for (const Property* property : properties()) {
    if (!property->has(in_scene) || property->key == "output.file") continue;
    for (const std::string& text : value_texts(scene, *property))
      if (!is_utf8(text)) return fmt::format("a scene is UTF-8, which {} {} is not", property->key, in_quotes(text));
  }
  return {};
}

}  // namespace meniscus
