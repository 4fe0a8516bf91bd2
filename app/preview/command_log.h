// SPDX-License-Identifier: BSD-3-Clause
// Sessions as files: one JSON command a line, written as they happen and carried out again.
#pragma once

#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <string>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/output_file.h"

namespace meniscus {

class PreviewSession;

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

/// Carries out the commands of the file `path`, up to one that asks to quit, and prints the replies.
void replay_commands(const std::string& path, std::span<const WrittenCommand> commands, PreviewSession& session,
                     std::ostream& replies);

}  // namespace meniscus
