// SPDX-License-Identifier: BSD-3-Clause
// Reads and writes commands, and merges two that follow each other; errors about values name the key.
#include "app/preview/command_json.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <ostream>

#include "core/base/text.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

/// Returns the text under a key; empty if there is none.
std::string text_under(const char* key, const nlohmann::json& command) {
  if (!command.is_object()) return "";
  const auto found = command.find(key);
  return found != command.end() && found->is_string() ? found->get<std::string>() : "";
}

void check_written(const std::ofstream& stream, const std::string& path) {
  if (!stream) throw OutputError(path, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace

std::string json_line(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

bool is_plain_name(std::string_view name) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
  constexpr std::size_t kLongest = 100;
  return !name.empty() && name.size() <= kLongest && name[0] != '.' && name[0] != '-' &&
         name.find_first_not_of(kLetters) == name.npos;
}

std::string command_word(const nlohmann::json& command) { return text_under("command", command); }

bool is_question(const nlohmann::json& command) {
  const std::string word = command_word(command);
  if (word == "pick") return command.value("wait", nlohmann::json()) == false;
  return word == "state" || word == "stats" || word == "choices" || word == "scene" || word == "render_command" ||
         word == "export_state" || word == "films" || word == "contents" || word == "locate";
}

bool changes_surface(std::string_view key) { return key == "surface.kind" || key == "surface.probe"; }

Change change_of(const nlohmann::json& command) {
  const std::string word = command_word(command);
  if (is_question(command) || word == "export" || word == "cancel_export" || word == "save" || word == "end_step")
    return Change::none;
  constexpr std::string_view kSurfaces[] = {"frame", "next_frame", "strip", "undo", "redo", "open", "quit"};
  if (word == "set" && changes_surface(text_under("key", command))) return Change::surface;
  return std::ranges::find(kSurfaces, word) != std::end(kSurfaces) ? Change::surface : Change::view;
}

bool merge_commands(nlohmann::json& first, const nlohmann::json& second) {
  constexpr std::array<std::string_view, 5> kLatest{"frame", "resize", "pick", "strip", "camera"};
  if (!first.is_object() || !second.is_object() || first.size() != second.size()) return false;
  const auto same = [&](const char* key) {
    return first.value(key, nlohmann::json()) == second.value(key, nlohmann::json());
  };
  const std::string word = command_word(first);
  if (!same("command")) return false;
  // A pick that waits is a click, and each click counts.
  const auto waits = [](const nlohmann::json& pick) { return !pick.contains("wait") || pick["wait"] != false; };
  if (word == "pick" && (waits(first) || waits(second))) return false;
  // An entry that is removed from a list gives its index to the next entry.
  const auto removes = [](const nlohmann::json& set) {
    return set.contains("index") && set.contains("value") && set["value"].is_null();
  };
  const bool same_value = word == "set" && same("key") && same("index") && !removes(first);
  if (!same_value && std::ranges::find(kLatest, word) == kLatest.end()) return false;
  if (std::ranges::any_of(first.items(), [&](const auto& item) { return !second.contains(item.key()); })) return false;
  first = second;
  return true;
}

CommandLog::CommandLog(const std::filesystem::path& path, Existing existing) : path_(path.string()) {
  check_output(path, existing);
  std::filesystem::remove(path);  // a new file: other hard links of the old one keep their content
  stream_.open(path, std::ios::trunc);
  check_written(stream_, path_);
}

void CommandLog::write(const nlohmann::json& command) {
  stream_ << json_line(command) << std::endl;
  check_written(stream_, path_);
}

std::vector<WrittenCommand> read_commands(const std::string& path) {
  std::ifstream stream(path);
  if (!stream) throw InputError(path, 0, "commands: the file cannot be opened");
  std::vector<WrittenCommand> commands;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (is_nested_too_deep(line)) throw InputError(path, number, "commands: this is nested too deep to be a command");
    commands.push_back({number, nlohmann::json::parse(line, nullptr, false)});
    if (commands.back().command.is_discarded()) throw InputError(path, number, "commands: this is not JSON");
  }
  if (stream.bad()) throw InputError(path, 0, "commands: the file cannot be read");
  return commands;
}

void print_reply(const std::string& path, std::size_t line, const nlohmann::json& reply, std::ostream& replies) {
  if (reply["ok"] == false) throw InputError(path, line, reply["error"]);
  replies << json_line(reply) << std::endl;
}

namespace {

/// Returns a value as messages show it: shortened and in one line.
std::string shown(const nlohmann::json& value) {
  constexpr std::size_t kLongest = 60;
  return shortened(value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace), kLongest);
}

}  // namespace

CommandReader::CommandReader(const nlohmann::json& command) : command_(command) {
  if (!command.is_object()) throw RequestError("a command is a JSON object such as {\"command\":\"state\"}");
}

void CommandReader::expect_only(std::span<const std::string_view> keys) const {
  for (const auto& [key, value] : command_.items()) {
    if (key == "command" || std::ranges::find(keys, key) != keys.end()) continue;
    throw RequestError("{}: unknown key {}; {}", shown_word(), in_quotes(key),
                       keys.empty() ? "it takes none" : fmt::format("it takes {}", fmt::join(keys, ", ")));
  }
}

const nlohmann::json& CommandReader::value(const char* key) const {
  const auto found = command_.find(key);
  if (found != command_.end()) return *found;
  if (std::string_view(key) == "command") throw RequestError("\"command\" is missing, the word that says what to do");
  throw RequestError("{}: \"{}\" is missing", shown_word(), key);
}

double CommandReader::number(const char* key, double lowest, double highest) const {
  const auto wanted = [&] { return fmt::format("a number from {} to {}", lowest, highest); };
  if (!value(key).is_number()) fail(key, wanted());
  const double number = value(key).get<double>();
  if (!(number >= lowest && number <= highest)) fail(key, wanted());
  return number;
}

int CommandReader::integer(const char* key, int lowest, int highest) const {
  if (highest < lowest) fail(key, "left out, because the list is still empty");
  const double number = value(key).is_number_integer() ? value(key).get<double>() : lowest - 1.0;
  if (!(number >= lowest && number <= highest)) fail(key, fmt::format("a whole number from {} to {}", lowest, highest));
  return static_cast<int>(number);
}

bool CommandReader::flag(const char* key) const {
  if (!value(key).is_boolean()) fail(key, "true or false");
  return value(key).get<bool>();
}

std::string CommandReader::text(const char* key) const {
  if (!value(key).is_string()) fail(key, "a text");
  return value(key).get<std::string>();
}

Selection CommandReader::selection() const {
  const std::string words = text("selection");
  return naming([&] { return parse_selection(words); });
}

std::size_t CommandReader::choice(const char* key, const std::vector<std::string>& words) const {
  const auto found = std::ranges::find(words, text(key));
  if (found == words.end()) fail(key, fmt::format("one of {}", fmt::join(words, ", ")));
  return static_cast<std::size_t>(found - words.begin());
}

std::string CommandReader::shown_word() const {
  constexpr std::size_t kLongest = 40;
  return shortened(word(), kLongest);
}

void CommandReader::fail(const char* key, const std::string& wanted) const {
  const bool named = std::string_view(key) != "command";
  throw RequestError("{}\"{}\" is {}; it must be {}", named ? shown_word() + ": " : "", key, shown(value(key)), wanted);
}

}  // namespace meniscus
