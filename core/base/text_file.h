// SPDX-License-Identifier: BSD-3-Clause
// A whole text file in memory, unpacked if gzipped, with bounds on what a hostile file may cost; its lines and fields.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// A file's text with LF line ends and without byte-order mark; never empty, free of NUL bytes.
struct TextFile {
  std::string path;  ///< as given, or "standard input"
  std::string text;
};

/// Reads a regular file, or standard input for "-", unpacking gzip (several members too) by its first bytes, not by its
/// name. Throws InputError: missing, unreadable, a folder, a named pipe or device, empty, binary, UTF-16, damaged gzip,
/// or changed while it was read, other than by appending, of which nothing is seen; CapacityError: more than `largest`
/// bytes after unpacking, or a line above 1 MiB.
TextFile read_text_file(const std::string& path, std::size_t largest = std::size_t{2} << 30);

/// The text of bytes that were read already, vetted as read_text_file does; path: for messages.
TextFile text_of_bytes(const std::string& path, std::string bytes);

/// The same for a file that may be binary: its bytes, unpacked, with nothing changed or looked at.
std::string read_file_bytes(const std::string& path, std::size_t largest = std::size_t{2} << 30);

/// Nothing of ours is nested as deep. JSON values are copied, compared and written by recursion, so that a file of
/// brackets alone would exhaust the stack.
inline constexpr int kDeepestJson = 64;

/// Do arrays and objects are in each other more than kDeepestJson levels deep? The text need not be JSON.
bool is_nested_too_deep(std::string_view json);

/// Goes through the lines of a text.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  /// The next line, without its end; false after the last one.
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

/// The cells of a line, without blanks at both ends; quotes around one may hold separators, two of them stand for one.
std::vector<std::string> csv_cells_of(std::string_view line, char separator = ',');

}  // namespace meniscus
