// SPDX-License-Identifier: BSD-3-Clause
// Reads scene files, and lets them name the files that their user knows of.
#include "app/options/scene_trust.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "app/options/named_files.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/image/png_file.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestScene = std::size_t{16} << 20;

[[noreturn]] void fail(const std::string& file, const std::string& place, const std::string& what) {
  throw InputError(file, 0, fmt::format("scene: {} {}", place, what));
}

}  // namespace

bool SceneTrust::has(const std::string& path) const {
  std::error_code ignored;
  const auto is_it = [&](const std::string& word) { return fs::equivalent(word, path, ignored); };
  return std::ranges::any_of(typed, is_it) || std::ranges::any_of(named, is_it);
}

std::string SceneTrust::path(const Property& property, const std::string& text, const std::string& place) const {
  const fs::path given(text);
  const std::string path = (given.is_absolute() ? given : fs::path(file).parent_path() / given).string();
  if (is_whole) return path;
  if (property.type != ValueType::new_file) {
    const bool leads_out = given.is_absolute() || std::ranges::find(given, fs::path("..")) != given.end();
    if (leads_out && !has(path))
      fail(file, place,
           fmt::format("is {}, outside of the scene's folder; name that file on the command line, or add "
                       "--trust-scene if the scene is yours",
                       in_quotes(text)));
    return path;
  }
  const std::string advice = fmt::format("name it by {} FILE, or add --trust-scene if the scene is yours",
                                         property.key == "output.file" ? "-o" : std::string(property.long_option()));
  if (given != given.filename())
    fail(
        file, place,
        fmt::format("is {}; a scene does not say in which folder its picture is written: {}", in_quotes(text), advice));
  std::error_code ignored;
  if (replaces && fs::exists(fs::symlink_status(path, ignored)))
    fail(file, place,
         fmt::format("is {}, which exists already; --force replaces what is named on the command line: {}",
                     in_quotes(text), advice));
  return path;
}

std::string read_scene_text(const std::string& file) {
  std::string text = png_note(file, kSceneNote).value_or("");
  if (!text.empty()) return text;
  if (is_png(file))
    throw InputError(file, 0,
                     "is a picture that carries no scene; pictures made with --no-provenance, frames of runs and "
                     "pictures of other programs have none");
  return std::string(read_text_file(file, kLargestScene).text);
}

void guard_scene_files(const CLI::App& command, const std::string& file, std::span<const SceneSetting> settings) {
  if (file.empty()) return;
  NamedFiles files(command);
  files.read(file);
  for (const SceneSetting& setting : settings)
    for (const std::string& text : setting.texts) {
      if (setting.property->type == ValueType::new_file)
        files.write(std::string(setting.property->long_option()), text);
      else if (setting.property->type == ValueType::file || setting.property->type == ValueType::camera)
        files.read(text);
    }
  files.check();
}

}  // namespace meniscus
