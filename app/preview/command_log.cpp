// SPDX-License-Identifier: BSD-3-Clause
// Recording commands, and reading what was recorded.
#include "app/preview/command_log.h"

#include <ostream>

#include "app/preview/command_json.h"
#include "core/base/error.h"
#include "core/base/text_file.h"

namespace meniscus {

CommandLog::CommandLog(const std::filesystem::path& path, Existing existing) : path_(path.string()) {
  check_output(path, existing);
  stream_.open(path, std::ios::trunc);
  if (!stream_) throw OutputError(path_, "cannot be written");
}

void CommandLog::write(const nlohmann::json& command) {
  stream_ << json_line(command) << std::endl;
  if (!stream_) throw OutputError(path_, "cannot be written");
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

}  // namespace meniscus
