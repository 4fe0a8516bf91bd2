// SPDX-License-Identifier: BSD-3-Clause
// Commands of a preview as JSON, without a session: lines and files of them, two that become one, and their values.
#pragma once

#include <fstream>
#include <iosfwd>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// A command or a reply as one line of text, without a line end; bytes that are not UTF-8 are replaced.
std::string json_line(const nlohmann::json& json);

/// Returns true if a name has at most 100 letters, digits, '.', '_' and '-', and does not begin with '.' or '-'.
bool is_plain_name(std::string_view name);

/// The text under "command"; empty if there is none.
std::string command_word(const nlohmann::json& command);

/// Does the command only ask: state, stats, choices, scene, render_command, export_state, films, contents, locate, or a
/// pick that does not wait? Any client may send it, and it is not recorded.
bool is_question(const nlohmann::json& command);

/// True if another value of this property makes another surface.
bool changes_surface(std::string_view key);

/// What a command will change, from the least to the most.
enum class Change {
  none,    ///< it asks, or exports
  view,    ///< the same surface will be seen otherwise
  surface  ///< there will be another surface, or an end
};
Change change_of(const nlohmann::json& command);

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

/// A command of a file, and the line it is in.
struct WrittenCommand {
  std::size_t line = 0;  ///< from 1
  nlohmann::json command;
};

/// The commands of a file, empty lines left out. Throws InputError, naming the line that is not JSON.
std::vector<WrittenCommand> read_commands(const std::string& path);

/// Throws InputError, naming the line, if the command was refused; else prints the reply as a line.
void print_reply(const std::string& path, std::size_t line, const nlohmann::json& reply, std::ostream& replies);

/// Reads {"command": WORD, ...}. Every function throws RequestError where the value is missing or not what it should
/// be. Lives shorter than the command.
class CommandReader {
 public:
  explicit CommandReader(const nlohmann::json& command);

  /// The value of "command".
  std::string word() const { return text("command"); }
  /// Complains about keys beside "command" and these.
  void expect_only(std::span<const std::string_view> keys) const;

  bool has(const char* key) const { return command_.contains(key); }
  const nlohmann::json& value(const char* key) const;
  /// lowest <= number <= highest, which are finite.
  double number(const char* key, double lowest, double highest) const;
  int integer(const char* key, int lowest, int highest) const;
  bool flag(const char* key) const;
  std::string text(const char* key) const;
  /// One of these words: its place in the list.
  std::size_t choice(const char* key, const std::vector<std::string>& words) const;
  /// "selection". Throws RequestError as all do.
  Selection selection() const;

  /// What `parse` makes of values of the command; its errors come to name the command.
  template <typename Parse>
  auto naming(const Parse& parse) const {
    try {
      return parse();
    } catch (const SelectionError& error) {
      throw RequestError(word() + ": " + error.sentence());
    } catch (const RequestError& error) {
      throw RequestError(word() + ": " + error.what());
    }
  }

  double number_or(double other, const char* key, double lowest, double highest) const {
    return has(key) ? number(key, lowest, highest) : other;
  }
  int integer_or(int other, const char* key, int lowest, int highest) const {
    return has(key) ? integer(key, lowest, highest) : other;
  }
  bool flag_or(bool other, const char* key) const { return has(key) ? flag(key) : other; }

 private:
  std::string shown_word() const;  // as it may be in a message
  [[noreturn]] void fail(const char* key, const std::string& wanted) const;

  const nlohmann::json& command_;
};

}  // namespace meniscus
