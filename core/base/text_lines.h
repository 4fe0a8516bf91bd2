// SPDX-License-Identifier: BSD-3-Clause
// Lines and fields of a text: blank-separated or comma-separated.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// Goes through the lines of a text.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  /// The next line, without its end; false behind the last one.
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++number_;
    return true;
  }

  std::size_t number() const { return number_; }  ///< of the line last given, from 1
  bool only_blanks_left() const { return rest_.find_first_not_of(" \t\n") == std::string_view::npos; }
  std::size_t bytes_left() const { return rest_.size(); }  ///< behind it

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// The text without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// Takes the first field off a line; empty if there is none.
std::string_view take_field(std::string_view& rest);

/// All fields of a line, at most `most` of them; the last one is then followed by more.
std::vector<std::string_view> fields_of(std::string_view line, std::size_t most = 64);

/// The cells of a line, without blanks at both ends; quotes around one may hold commas, two of them stand for one.
std::vector<std::string> csv_cells_of(std::string_view line);

}  // namespace meniscus
