// SPDX-License-Identifier: BSD-3-Clause
// Parses numbered paths, refuses outputs that would replace inputs or each other, and reads and writes storyboards.
#include "app/options/named_files.h"

#include <algorithm>

#include <nlohmann/json.hpp>
#include <CLI/CLI.hpp>

#include "app/options/command_tree.h"
#include "app/process/program_main.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/properties/properties.h"

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

std::optional<NumberedPath> NumberedPath::parse(const std::string& path) {
  const std::size_t last = path.rfind('#'), slash = path.rfind('/');
  if (last == std::string::npos || (slash != std::string::npos && last < slash)) return {};
  std::size_t first = last;
  while (first > 0 && path[first - 1] == '#') --first;
  NumberedPath numbered;
  numbered.before_ = path.substr(0, first);
  numbered.behind_ = path.substr(last + 1);
  numbered.digits_ = last + 1 - first;
  return numbered;
}

std::string NumberedPath::at(std::uint64_t number) const {
  return fmt::format("{}{:0{}}{}", before_, number, digits_, behind_);
}

bool NumberedPath::names(std::string_view path) const {
  if (path.size() < before_.size() + digits_ + behind_.size() || !path.starts_with(before_) || !path.ends_with(behind_))
    return false;
  const std::string_view number = path.substr(before_.size(), path.size() - before_.size() - behind_.size());
  return number.find_first_not_of("0123456789") == std::string_view::npos &&
         (number.size() == digits_ || number.front() != '0');
}

std::string numbered_name(const std::string& path) {
  const std::filesystem::path plain(path);
  const std::string ending = plain.has_extension() ? plain.extension().string() : ".png";
  return (plain.parent_path() / (plain.stem().string() + "_#####" + ending)).string();
}

namespace {

namespace fs = std::filesystem;

bool is_output(const Property& property) { return property.type == ValueType::new_file; }
bool names_input(const Property& property) { return property.value.ends_with("=FILE"); }

bool is_one(const CLI::Option& option, bool (*such)(const Property& property)) {
  return std::ranges::any_of(properties(), [&](const Property* property) {
    return property->long_option() == option.get_name() && such(*property);
  });
}

/// Returns true if both paths are one file, or would be for some number instead of #.
bool can_be_one_file(const std::string& a, const std::string& b) {
  std::error_code failed, ignored;
  // The path is made absolute first, because weakly_canonical() leaves a path relative if no part of it exists.
  const auto place = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path, failed), failed).string();
  };
  const auto has_frame_in = [](const std::string& numbered, const std::string& other) {
    constexpr std::uint64_t kSomeFrame = 987654321;  // has as many digits as either of two patterns requires
    const std::optional<NumberedPath> frames = NumberedPath::parse(numbered), others = NumberedPath::parse(other);
    return frames && frames->names(others ? others->at(kSomeFrame) : other);
  };
  const std::string first = place(a), second = place(b);
  return first == second || fs::equivalent(a, b, ignored) || has_frame_in(first, second) || has_frame_in(second, first);
}

}  // namespace

NamedFiles::NamedFiles(const CLI::App& command) {
  for (const CLI::Option* const option : command.get_options()) {
    for (const std::string& path : option->results())
      if (is_one(*option, is_output))
        write(option->get_name(), path);
      else if (is_one(*option, names_input))
        read(path.substr(path.find('=') + 1));
      else if (takes_path(*option))
        read(path);
  }
}

void NamedFiles::protect(const fs::path& path) {
  protect_input(path);
  const std::optional<system_file::State> state = system_file::state_of(path);
  if (state && state->kind == system_file::State::Kind::file) inputs_.insert(state->identity);
}

void NamedFiles::read(const std::string& text) {
  const fs::path path = path_of_text(text);
  protect(path);
  std::error_code ignored;
  if (!fs::exists(path / "bundle.json", ignored)) return;
  protect(path / "bundle.json");
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path / "inputs", ignored))
    protect(entry.path());
}

void NamedFiles::write(const std::string& option, const std::string& path) {
  if (path != "-") outputs_.emplace_back(option, path);
}

void NamedFiles::check() const {
  for (const auto& [option, path] : outputs_)
    if (const std::optional<system_file::State> state = system_file::state_of(path_of_text(path));
        state && inputs_.contains(state->identity))
      throw OutputError(path, "is one of the files that this command reads; choose another name");
  for (std::size_t a = 0; a < outputs_.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (outputs_[a].first != outputs_[b].first && can_be_one_file(outputs_[a].second, outputs_[b].second))
        throw UsageError("{} and {} name the same file, {}; choose two", outputs_[b].first, outputs_[a].first,
                         in_quotes(outputs_[a].second));
}

}  // namespace meniscus
