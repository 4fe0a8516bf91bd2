// SPDX-License-Identifier: BSD-3-Clause
// The values of one JSON command, with complaints that name the key, the value and what is wanted.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/properties/property.h"
#include "core/structure/selection/selection.h"

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
  std::size_t choice(const char* key, const std::vector<std::string>& words) const;
  /// The same within the limits, or of the words, of a property.
  double number(const char* key, const Property& property) const {
    return number(key, property.lowest, property.highest);
  }
  int integer(const char* key, const Property& property) const {
    return integer(key, static_cast<int>(property.lowest), static_cast<int>(property.highest));
  }
  std::size_t choice(const char* key, const Property& property) const { return choice(key, words_of(property)); }
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
  std::string shown_word() const;  // as it may stand in a message
  [[noreturn]] void fail(const char* key, const std::string& wanted) const;

  const nlohmann::json& command_;
};

}  // namespace meniscus
