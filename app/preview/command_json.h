// SPDX-License-Identifier: BSD-3-Clause
// Commands of a preview as text, and which of them only ask; for those who pass commands on without a session.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace meniscus {

/// A command or a reply as one line of text, without a line end; bytes that are no UTF-8 are replaced.
std::string json_line(const nlohmann::json& json);

/// The text under "command"; empty if there is none.
std::string command_word(const nlohmann::json& command);

/// What an error says, without the word of its command, which is a program's and no reader's.
std::string sentence_of(const std::string& error, const std::string& word);

/// Does the command only ask: state, stats, choices, render_command, export_state, or a pick that does not wait?
/// Anybody may, and nobody records it.
bool is_question(const nlohmann::json& command);

/// What a command will change, from the least to the most.
enum class Change {
  none,    ///< it asks, or exports
  view,    ///< the same surface will be seen otherwise
  surface  ///< there will be another surface, or an end
};
Change change_of(const nlohmann::json& command);

}  // namespace meniscus
