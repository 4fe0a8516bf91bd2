// SPDX-License-Identifier: BSD-3-Clause
// Commands of a preview as JSON, without a session: lines and files of them, their kinds, two that become one.
#pragma once

#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/output_file.h"

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

/// The most by which one command zooms in, and its reciprocal out, however many turns of a wheel became one.
inline constexpr double kMostZoom = 1e300;

/// Makes one command of two that follow each other, `first` then `second`; false if both are needed.
bool merge_commands(nlohmann::json& first, const nlohmann::json& second);

/// Writes a session while it goes on: each line is complete as soon as its command was carried out, however the program
/// ends.
class CommandLog {
 public:
  /// Throws OutputError: the file exists (Existing::refuse) or cannot be written.
  CommandLog(const std::filesystem::path& path, Existing existing);
  /// Throws OutputError.
  void write(const nlohmann::json& command);

 private:
  std::string path_;
  std::ofstream stream_;
};

/// A command of a file, and the line it stands in.
struct WrittenCommand {
  std::size_t line = 0;  ///< from 1
  nlohmann::json command;
};

/// The commands of a file, empty lines left out. Throws InputError, naming the line that is no JSON.
std::vector<WrittenCommand> read_commands(const std::string& path);

/// Throws InputError, naming the line, if the command was refused; else prints the reply as a line.
void print_reply(const std::string& path, std::size_t line, const nlohmann::json& reply, std::ostream& replies);

}  // namespace meniscus
