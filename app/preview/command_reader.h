// SPDX-License-Identifier: BSD-3-Clause
// The values of one JSON command, with complaints that name the key, the value and what is wanted.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace meniscus {

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
  std::size_t choice(const char* key, std::initializer_list<std::string_view> words) const;

  double number_or(double other, const char* key, double lowest, double highest) const {
    return has(key) ? number(key, lowest, highest) : other;
  }
  int integer_or(int other, const char* key, int lowest, int highest) const {
    return has(key) ? integer(key, lowest, highest) : other;
  }
  bool flag_or(bool other, const char* key) const { return has(key) ? flag(key) : other; }

 private:
  std::string shown_word() const;  // as it may stand in a message
  [[noreturn]] void fail(const char* key, const std::string& wanted) const;

  const nlohmann::json& command_;
};

}  // namespace meniscus
