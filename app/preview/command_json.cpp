// SPDX-License-Identifier: BSD-3-Clause
// Lines of JSON.
#include "app/preview/command_json.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace meniscus {

std::string json_line(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string command_word(const nlohmann::json& command) {
  if (!command.is_object()) return "";
  const auto found = command.find("command");
  return found != command.end() && found->is_string() ? found->get<std::string>() : "";
}

std::string sentence_of(const std::string& error, const std::string& word) {
  return error.starts_with(word + ": ") ? error.substr(word.size() + 2) : error;
}

bool is_question(const nlohmann::json& command) {
  const std::string word = command_word(command);
  if (word == "pick") return command.value("wait", nlohmann::json()) == false;
  return word == "state" || word == "stats" || word == "choices" || word == "render_command" || word == "export_state";
}

Change change_of(const nlohmann::json& command) {
  const std::string word = command_word(command);
  if (is_question(command) || word == "export" || word == "cancel_export" || word == "save" || word == "end_step")
    return Change::none;
  constexpr std::string_view kSurfaces[] = {"surface", "probe", "frame", "next_frame", "undo", "redo", "open", "quit"};
  return std::ranges::find(kSurfaces, word) != std::end(kSurfaces) ? Change::surface : Change::view;
}

}  // namespace meniscus
