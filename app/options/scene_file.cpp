// SPDX-License-Identifier: BSD-3-Clause
// Reads scene files into the words of a command line, and writes them, by the table of properties.
#include "app/options/scene_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "app/options/property_options.h"
#include "app/options/usage_faults.h"
#include "app/process/program_error.h"
#include "core/base/error.h"
#include "core/base/text_file.h"
#include "core/base/text.h"
#include "core/image/png_file.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;
namespace fs = std::filesystem;

constexpr const char* kVersionKey = "meniscus_scene";
constexpr int kVersion = 1;
constexpr std::size_t kLargestScene = std::size_t{16} << 20;
constexpr const char* kOutput = "--output";
/// What scenes call them, and the options.
constexpr std::array<std::pair<std::string_view, const char*>, 4> kShapes{
    {{"sticks", "--sticks"}, {"balls", "--balls"}, {"spheres", "--spheres"}, {"tube", "--tube"}}};

const CLI::App* subcommand(const CLI::App& app, const std::string& name) {
  for (const CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; }))
    if (below->get_name() == name) return below;
  return nullptr;
}

const CLI::Option* option_of(const CLI::App& command, std::string_view name) {
  return command.get_option_no_throw(std::string(name));
}

std::string option_name(const std::string& word) { return word.substr(0, word.find('=')); }

/// Whether words behind a command's name have an argument, which is a word that is neither an option nor its value.
bool has_argument(const CLI::App& command, const Words& words) {
  for (std::size_t n = 0; n < words.size(); ++n) {
    const std::string& word = words[n];
    if (word.size() < 2 || word[0] != '-') return true;
    const CLI::Option* const option = option_of(command, option_name(word));
    if (!option || word.find('=') != std::string::npos) continue;
    for (int left = option->get_expected_max(); left > 0 && n + 1 < words.size(); --left) {
      const std::string& next = words[n + 1];
      if (option->get_expected_min() == 0 && next.starts_with('-')) break;
      ++n;
      if (option->get_allow_extra_args()) continue;
      if (option->get_items_expected_max() <= 1 || next.find(',') != std::string::npos) break;
    }
  }
  return false;
}

/// Takes --scene FILE out of words; those behind "--" are another program's.
std::string take_scene(Words& words) {
  std::string file;
  const auto end = std::ranges::find(words, "--");
  Words left;
  for (auto word = words.begin(); word != end; ++word) {
    if (word->starts_with("--scene=")) {
      file = word->substr(std::string_view("--scene=").size());
    } else if (*word == "--scene") {
      if (++word == end) throw UsageError("--scene needs a FILE");
      file = *word;
    } else {
      left.push_back(*word);
      continue;
    }
    if (file.empty()) throw UsageError("--scene needs a FILE");
  }
  left.insert(left.end(), end, words.end());
  words = std::move(left);
  return file;
}

/// What somebody who uses a scene has said of files: what was typed, and files named before.
struct SceneTrust {
  const Words& typed;
  const Words& named;
  bool has_molecule;  ///< it was typed

  bool has(std::string_view option) const {
    return std::ranges::any_of(typed, [&](const std::string& word) { return option_name(word) == option; });
  }
  bool is_whole() const { return has("--trust-scene") || std::ranges::find(named, "--trust-scene") != named.end(); }
  bool has_file(const fs::path& path) const {
    std::error_code ignored;
    const auto is_it = [&](const std::string& word) {
      return fs::equivalent(word.substr(word.starts_with("--") ? word.find('=') + 1 : 0), path, ignored);
    };
    return std::ranges::any_of(typed, is_it) || std::ranges::any_of(named, is_it);
  }
};

/// The words of one scene for one command.
class SceneReader {
 public:
  SceneReader(const CLI::App& command, const std::string& file, const SceneTrust& trust)
      : command_(command), file_(file), trust_(trust), shows_(option_of(command, "--color") != nullptr) {}

  void read() {
    const Json scene = parse();
    for (const auto& [section, value] : scene.items()) {
      if (section == kVersionKey || section == "objects") continue;
      check_section(section);
      if (!value.is_object()) fail(section, "is no JSON object {...}");
      for (const auto& [key, own] : value.items()) {
        if (section == "molecule" && key == "select") continue;
        add(section, key, own, fmt::format("{}.{}", section, key));
      }
    }
    read_objects(scene);
  }

  const std::string& molecule() const { return molecule_; }
  const Words& words() const { return words_; }
  const std::map<std::string, std::string>& keys() const { return keys_; }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& what) const {
    throw InputError(file_, 0, fmt::format("scene: {} {}", place, what));
  }

  Json parse() const {
    const std::string text = png_note(file_, kSceneNote).value_or("");
    if (text.empty() && is_png(file_))
      throw InputError(file_, 0,
                       "is a picture that carries no scene; pictures made with --no-provenance, frames of runs and "
                       "pictures of other programs have none");
    const TextFile read = text.empty() ? read_text_file(file_, kLargestScene) : TextFile{};
    const std::string_view json = text.empty() ? std::string_view(read.text) : std::string_view(text);
    if (is_nested_too_deep(json)) throw InputError(file_, 0, "scene: is nested too deep to be one");
    Json scene;
    try {
      scene = Json::parse(json);
    } catch (const Json::parse_error& error) {
      const auto end = json.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, json.size()));
      throw InputError(file_, static_cast<std::size_t>(1 + std::count(json.begin(), end, '\n')),
                       "scene: this is not JSON");
    } catch (const Json::exception&) {
      throw InputError(file_, 0, "scene: a number is too large");
    }
    if (!scene.is_object() || !scene.contains(kVersionKey))
      throw InputError(file_, 0, fmt::format("is no scene: it has no \"{}\": {}", kVersionKey, kVersion));
    if (scene[kVersionKey] != kVersion)
      throw InputError(file_, 0,
                       fmt::format("scene: \"{}\" is {}; this program reads version {}", kVersionKey,
                                   escaped(scene[kVersionKey].dump()), kVersion));
    return scene;
  }

  void check_section(const std::string& section) const {
    std::vector<std::string_view> sections{"objects"};
    for (const Property* property : properties())
      if (property->has(in_scene) && property->section() != "surface" &&
          std::ranges::find(sections, property->section()) == sections.end())
        sections.push_back(property->section());
    if (std::ranges::find(sections, section) == sections.end())
      fail(in_quotes(section), "is no part of a scene" + meant(section, sections));
  }

  static std::string meant(const std::string& word, const std::vector<std::string_view>& words) {
    const std::string_view nearest = nearest_word(word, words);
    return nearest.empty() ? fmt::format("; there are {}", fmt::join(words, ", "))
                           : fmt::format("; did you mean {}?", nearest);
  }

  const Property& property_of_key(const std::string& section, const std::string& key, const std::string& place) const {
    std::vector<std::string_view> keys;
    for (const Property* known : properties()) {
      if (!known->has(in_scene) || known->section() != section) continue;
      if (known->name() == key) return *known;
      keys.push_back(known->name());
    }
    fail(place, "is no key" + meant(key, keys));
  }

  void add(const std::string& section, const std::string& name, const Json& value, const std::string& place) {
    const Property& property = property_of_key(section, name, place);
    if (property.option == "FILE") {
      if (!trust_.has_molecule) molecule_ = path(value, place);
      return;
    }
    const std::string option(property.long_option());
    // The name of a picture does not fit the folder of an export.
    if (option == kOutput && command_.get_name() != "render") return;
    if (!takes(option, property.has(needs_support) && !changes_nothing(property, value), place)) return;
    const SceneForm form = scene_form(property);
    if (form == SceneForm::path && (trust_.has(option) || (option == kOutput && trust_.has("-o")))) return;
    keys_[option] = place;
    switch (form) {
      case SceneForm::flag:
      case SceneForm::negated:
        if (!value.is_boolean()) fail(place, "is neither true nor false");
        if (value.get<bool>() == (form == SceneForm::flag)) words_.push_back(option);
        return;
      case SceneForm::text_or_flag:
        if (value.is_boolean()) {
          if (value.get<bool>()) words_.push_back(option);
          return;
        }
        [[fallthrough]];
      case SceneForm::text:
        return add_word(option, text(value, place));
      case SceneForm::list:
        for (const Json& one : listed(value)) add_word(option, text(one, place));
        return;
      case SceneForm::path:
        return add_word(option,
                        property.type == ValueType::new_file ? output(option, value, place) : path(value, place));
      case SceneForm::paths:
        for (const Json& one : listed(value)) add_word(option, path(one, place));
        return;
      case SceneForm::camera:
        return add_word(option, value.is_object() ? value.dump() : path(value, place));
    }
  }

  /// Whether the value means the same as leaving the key out.
  static bool changes_nothing(const Property& property, const Json& value) {
    switch (scene_form(property)) {
      case SceneForm::flag:
      case SceneForm::negated:
        return value == Json(property.has(negated));
      case SceneForm::list:
        return value.is_array() && value.empty();
      default:
        return !property.without.empty() && value == Json(property.without);
    }
  }

  void add_word(const std::string& option, const std::string& value) { words_.push_back(option + "=" + value); }

  /// Whether the command has the option. `shows`: without it something else would be seen.
  bool takes(const std::string& option, bool shows, const std::string& place) const {
    if (option_of(command_, option)) return true;
    if (shows && shows_)
      throw UsageError(fmt::format("{}: {}: {} cannot show that ({}); leave it out of the scene, or choose render",
                                   escaped(file_), place, command_path(command_), option));
    return false;
  }

  std::string text(const Json& value, const std::string& place) const {
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_number()) fail(place, "is neither a text nor a number");
    return value.dump();
  }

  static std::vector<Json> listed(const Json& value) {
    return value.is_array() ? value.get<std::vector<Json>>() : std::vector<Json>{value};
  }

  /// As the scene has it, and as seen from here.
  std::pair<fs::path, fs::path> paths_of(const Json& value, const std::string& place) const {
    if (!value.is_string() || value.get<std::string>().empty()) fail(place, "is no path");
    const fs::path given(value.get<std::string>());
    return {given, given.is_absolute() ? given : fs::path(file_).parent_path() / given};
  }

  std::string path(const Json& value, const std::string& place) const {
    const auto [given, path] = paths_of(value, place);
    const bool leads_out = given.is_absolute() || std::ranges::find(given, fs::path("..")) != given.end();
    if (leads_out && !trust_.is_whole() && !trust_.has_file(path))
      fail(place, fmt::format("is {}, outside of the scene's folder; name that file on the command line, or add "
                              "--trust-scene if the scene is yours",
                              in_quotes(given.string())));
    return path.string();
  }

  std::string output(const std::string& option, const Json& value, const std::string& place) const {
    const auto [given, path] = paths_of(value, place);
    const std::string advice = fmt::format("name it by {} FILE, or add --trust-scene if the scene is yours",
                                           option == kOutput ? "-o" : option);
    if (trust_.is_whole()) return path.string();
    if (given != given.filename())
      fail(place, fmt::format("is {}; a scene does not say in which folder its picture is written: {}",
                              in_quotes(given.string()), advice));
    std::error_code ignored;
    if (trust_.has("--force") && fs::exists(fs::symlink_status(path, ignored)))
      fail(place, fmt::format("is {}, which exists already; --force replaces what is named on the command line: {}",
                              in_quotes(given.string()), advice));
    return path.string();
  }

  void read_objects(const Json& scene) {
    std::string select;
    if (scene.contains("molecule") && scene["molecule"].contains("select"))
      select = text(scene["molecule"]["select"], "molecule.select");
    std::string select_place = "molecule.select";
    if (scene.contains("objects")) {
      const Json& objects = scene["objects"];
      if (!objects.is_array()) fail("objects", "is no JSON list [...]");
      bool has_surface = false;
      for (std::size_t n = 0; n < objects.size(); ++n) {
        const std::string place = fmt::format("objects[{}]", n);
        const Json& object = objects[n];
        if (!object.is_object()) fail(place, "is no JSON object {...}");
        const Json word = object.value("representation", Json("surface"));
        if (word != "surface" || has_surface) {
          read_object(object, place);
          continue;
        }
        has_surface = true;
        for (const auto& [key, value] : object.items()) {
          if (key == "representation") continue;
          if (key == "selection") {
            const std::string own = text(value, place + ".selection");
            select = select.empty() ? own : fmt::format("({}) and ({})", select, own);
            select_place = place + ".selection";
          } else {
            add("surface", key, value, fmt::format("{}.{}", place, key));
          }
        }
      }
      if (!has_surface && takes("--hide-surface", true, "objects without a surface"))
        words_.emplace_back("--hide-surface");
    }
    if (select.empty() || !option_of(command_, "--select")) return;
    keys_["--select"] = select_place;
    add_word("--select", select);
  }

  void read_object(const Json& object, const std::string& place) {
    if (!shows_) return;
    for (const auto& [word, option] : kShapes) {
      if (object.size() != 2 || object.value("representation", Json()) != word || !object.contains("selection"))
        continue;
      if (!takes(option, true, place)) return;
      keys_[option] = place;
      return add_word(option, text(object["selection"], place + ".selection"));
    }
    if (!takes("--object", true, place)) return;
    keys_["--object"] = place;
    add_word("--object", object.dump());
  }

  const CLI::App& command_;
  const std::string file_;
  const SceneTrust& trust_;
  const bool shows_;  // pictures or exports
  std::string molecule_;
  Words words_;
  std::map<std::string, std::string> keys_;
};

/// As a number if it is written as JSON writes numbers.
Json value_of(const std::string& text) {
  const Json number = Json::parse(text, nullptr, false);
  return number.is_number() && number.dump() == text ? number : Json(text);
}

/// What was given of an option that counts once, its values with commas between.
std::string last_value(const CLI::Option& option) {
  const std::vector<std::string>& all = option.results();
  const auto count = static_cast<std::size_t>(std::max(option.get_items_expected_min(), 1));
  const std::size_t first = all.size() > count ? all.size() - count : 0;
  return fmt::format("{}", fmt::join(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(), ","));
}

std::string seen_from(const std::string& folder, const std::string& path) {
  if (folder.empty()) return fs::path(path).filename().string();
  std::error_code failed;
  const fs::path seen = fs::proximate(fs::absolute(path), fs::absolute(folder), failed);
  return failed ? fs::absolute(path).string() : seen.string();
}

Json value_of(const Property& property, const CLI::Option& option, const std::string& folder) {
  const std::vector<std::string>& all = option.results();
  const SceneForm form = scene_form(property);
  switch (form) {
    case SceneForm::flag:
    case SceneForm::negated: {
      const bool given = !all.empty() && all.back() != "false";
      return given == (form == SceneForm::flag);
    }
    case SceneForm::text_or_flag:
      if (all.empty() || all.back().empty() || all.back() == "auto") return true;
      return value_of(last_value(option));
    case SceneForm::text:
      return value_of(last_value(option));
    case SceneForm::list: {
      if (all.size() == 1) return value_of(all.front());
      Json list = Json::array();
      for (const std::string& one : all) list.push_back(value_of(one));
      return list;
    }
    case SceneForm::path:
      return seen_from(folder, all.back());
    case SceneForm::paths: {
      Json list = Json::array();
      for (const std::string& one : all) list.push_back(seen_from(folder, one));
      return list;
    }
    case SceneForm::camera:
      if (all.back().starts_with('{')) return Json::parse(all.back(), nullptr, false);
      return seen_from(folder, all.back());
  }
  return {};
}

}  // namespace

std::string SceneWords::name_key(const std::string& message) const {
  for (const auto& [option, place] : keys)
    if (message.starts_with(option + ":") || message.starts_with(option + " "))
      return fmt::format("{}: {}: {}", escaped(file), place, message);
  return message;
}

SceneWords with_scene(const CLI::App& program, Words words, const Words& named) {
  SceneWords result;
  result.file = take_scene(words);
  if (result.file.empty()) {
    result.words = std::move(words);
    return result;
  }
  const CLI::App* command = &program;
  std::size_t depth = 0;
  while (depth < words.size()) {
    const CLI::App* const below = subcommand(*command, words[depth]);
    if (!below) break;
    command = below;
    ++depth;
  }
  if (!option_of(*command, "--scene"))
    throw UsageError(
        fmt::format("{} takes no --scene; render, export, preview and surface do", command_path(*command)));
  const auto typed = words.begin() + static_cast<std::ptrdiff_t>(depth);
  const Words behind(typed, words.end());
  const SceneTrust trust{behind, named, has_argument(*command, behind)};
  SceneReader scene(*command, result.file, trust);
  scene.read();
  result.words.assign(words.begin(), typed);
  if (!trust.has_molecule) {
    if (scene.molecule().empty())
      throw InputError(result.file, 0, "scene: molecule.file is missing; name it there, or on the command line");
    result.words.push_back(scene.molecule());
  }
  result.words.insert(result.words.end(), scene.words().begin(), scene.words().end());
  result.words.insert(result.words.end(), behind.begin(), behind.end());
  // The preview's own defaults are not those of the picture that a scene is.
  if (command->get_name() == "preview") result.words.push_back("--scene=" + result.file);
  result.keys = scene.keys();
  for (const std::string& word : behind) result.keys.erase(word == "-o" ? "--output" : option_name(word));
  return result;
}

void add_scene_options(CLI::App& command, std::string* save_path) {
  PropertyOptions options(command);
  options.add_parsed("scene.read", [](const std::string&) {});  // with_scene() has read it by then
  options.add_switch("scene.trust", [] {});
  if (save_path) options.add("scene.save", *save_path);
}

SceneOutput::SceneOutput(const CLI::App& command, const std::string& path, Existing existing) {
  if (path.empty()) return;
  if (const CLI::Option* const file = option_of(command, "FILE");
      file && file->count() > 0 && file->results().back() == "-")
    throw UsageError("--save-scene: a scene names its molecule's file, which standard input is not");
  file_.emplace(path, existing);
  const fs::path folder = fs::path(path).parent_path();
  file_->write(scene_text(command, folder.empty() ? "." : folder.string()));
}

void SceneOutput::commit() {
  if (file_) file_->commit();
}

std::string scene_text(const CLI::App& command, const std::string& folder) {
  Json scene;
  scene[kVersionKey] = kVersion;
  Json objects = Json::array({{{"representation", "surface"}}});
  for (const Property* property : properties()) {
    const CLI::Option* const option = property->has(in_scene) ? option_of(command, property->long_option()) : nullptr;
    if (!option || option->count() == 0 || (folder.empty() && property->section() == "output")) continue;
    const std::string section(property->section()), name(property->name());
    (section == "surface" ? objects.front() : scene[section])[name] = value_of(*property, *option, folder);
  }
  for (const auto& [word, name] : kShapes)
    if (const CLI::Option* const option = option_of(command, name))
      for (const std::string& selection : option->results())
        objects.push_back({{"representation", word}, {"selection", selection}});
  if (const CLI::Option* const option = option_of(command, "--object"))
    for (const std::string& json : option->results()) objects.push_back(Json::parse(json, nullptr, false));
  Json ordered;  // what is drawn stands before how
  for (const char* section : {kVersionKey, "molecule", "frames"})
    if (scene.contains(section)) ordered[section] = scene[section];
  ordered["objects"] = std::move(objects);
  for (const auto& [section, keys] : scene.items())
    if (!ordered.contains(section)) ordered[section] = keys;
  return ordered.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace meniscus
