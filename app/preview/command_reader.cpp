// SPDX-License-Identifier: BSD-3-Clause
// Checks types and ranges of a command's values.
#include "app/preview/command_reader.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

/// A value as it may stand in a message: short, and in one line.
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
    throw RequestError(fmt::format("{}: unknown key {}; {}", shown_word(), in_quotes(key),
                                   keys.empty() ? "it takes none" : fmt::format("it takes {}", fmt::join(keys, ", "))));
  }
}

const nlohmann::json& CommandReader::value(const char* key) const {
  const auto found = command_.find(key);
  if (found != command_.end()) return *found;
  if (std::string_view(key) == "command") throw RequestError("\"command\" is missing, the word that says what to do");
  throw RequestError(fmt::format("{}: \"{}\" is missing", shown_word(), key));
}

double CommandReader::number(const char* key, double lowest, double highest) const {
  const auto wanted = [&] { return fmt::format("a number from {} to {}", lowest, highest); };
  if (!value(key).is_number()) fail(key, wanted());
  const double number = value(key).get<double>();
  if (!(number >= lowest && number <= highest)) fail(key, wanted());
  return number;
}

int CommandReader::integer(const char* key, int lowest, int highest) const {
  if (highest < lowest) fail(key, "left out, for there is nothing yet that it could name");
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
  throw RequestError(
      fmt::format("{}\"{}\" is {}; it must be {}", named ? shown_word() + ": " : "", key, shown(value(key)), wanted));
}

}  // namespace meniscus
