// SPDX-License-Identifier: BSD-3-Clause
// Reads commands of a preview as JSON from lines and files, merges them and checks their values.
#pragma once

#include <fstream>
#include <iosfwd>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// Returns a command or a reply as one line of text without a line end; bytes that are not UTF-8 are replaced.
std::string json_line(const nlohmann::json& json);

/// Returns true if a name has at most 100 letters, digits, '.', '_' and '-', and does not begin with '.' or '-'.
bool is_plain_name(std::string_view name);

/// Returns the text under "command"; empty if there is none.
std::string command_word(const nlohmann::json& command);

/// Returns true if the command only asks: state, stats, choices, scene, render_command, export_state, films, contents,
/// locate, or a pick that does not wait. Any client may send it, and it is not recorded.
bool is_question(const nlohmann::json& command);

/// Returns true if another value of this property makes another surface.
bool changes_surface(std::string_view key);

/// How much a command will change, from the least to the most.
enum class Change {
  none,    ///< the command asks or exports
  view,    ///< the same surface will look different
  surface  ///< there will be another surface, or the session will end
};
Change change_of(const nlohmann::json& command);

/// Merges two commands that follow each other into `first`; returns false if both are needed.
bool merge_commands(nlohmann::json& first, const nlohmann::json& second);

/// Writes a session while it goes on: each line is complete as soon as its command was carried out.
class CommandLog {
 public:
  /// Throws OutputError if the file cannot be written, or if it exists and `existing` is Existing::refuse.
  CommandLog(const std::filesystem::path& path, Existing existing);
  /// Throws OutputError.
  void write(const nlohmann::json& command);

 private:
  std::string path_;
  std::ofstream stream_;
};

/// A command of a file, and the number of its line.
struct WrittenCommand {
  std::size_t line = 0;  ///< from 1
  nlohmann::json command;
};

/// Returns the commands of a file without its empty lines. Throws InputError that names the line that is not JSON.
std::vector<WrittenCommand> read_commands(const std::string& path);

/// Prints the reply as a line. Throws InputError that names the line if the command was refused.
void print_reply(const std::string& path, std::size_t line, const nlohmann::json& reply, std::ostream& replies);

/// Reads the values of {"command": WORD, ...}. Every function throws RequestError if the value is missing or not valid.
/// The command must live longer than its reader.
class CommandReader {
 public:
  explicit CommandReader(const nlohmann::json& command);

  std::string word() const { return text("command"); }
  /// Throws RequestError if there are other keys than "command" and these.
  void expect_only(std::span<const std::string_view> keys) const;

  bool has(const char* key) const { return command_.contains(key); }
  const nlohmann::json& value(const char* key) const;
  /// Returns a number from lowest to highest, which are finite.
  double number(const char* key, double lowest, double highest) const;
  int integer(const char* key, int lowest, int highest) const;
  bool flag(const char* key) const;
  std::string text(const char* key) const;
  /// Returns the index of the value in a list of words.
  std::size_t choice(const char* key, const std::vector<std::string>& words) const;
  /// Returns the value of "selection".
  Selection selection() const;

  /// Returns the result of `parse`, which reads values of the command; its errors get the name of the command.
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
  std::string shown_word() const;  // the word as messages show it
  [[noreturn]] void fail(const char* key, const std::string& wanted) const;

  const nlohmann::json& command_;
};

}  // namespace meniscus
