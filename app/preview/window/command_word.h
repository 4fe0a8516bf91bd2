// SPDX-License-Identifier: BSD-3-Clause
// The word of a command that may be any JSON, as a file of commands may hold.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace meniscus {

/// The text under "command"; empty if there is none.
inline std::string command_word(const nlohmann::json& command) {
  if (!command.is_object()) return "";
  const auto found = command.find("command");
  return found != command.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace meniscus
