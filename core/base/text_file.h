// SPDX-License-Identifier: BSD-3-Clause
// Text files: reading one whole, with bounds on what a hostile file may cost, and splitting it into lines and fields.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// The text of a file, with LF line ends and without byte-order mark. It is not empty and has no NUL bytes.
struct TextFile {
  std::string path;  ///< as given, or "standard input"
  std::string text;
};

/// Reads a regular file, or standard input for "-". gzip data, also with several members, is recognized by its first
/// bytes and unpacked. Bytes that are appended to the file meanwhile are not read.
/// Throws InputError if the file is missing, unreadable, a folder, a named pipe or device, empty, binary, UTF-16 or
/// damaged gzip, or if it was changed while it was read, other than by appending. Throws CapacityError for more than
/// `largest` bytes after unpacking, or a line above 1 MiB.
TextFile read_text_file(const std::string& path, std::size_t largest = std::size_t{2} << 30);

/// Returns the text of bytes in memory, with the checks of read_text_file. path: the name of the file, for messages.
TextFile text_of_bytes(const std::string& path, std::string bytes);

/// Reads a file that may be binary, and returns its bytes after unpacking. Throws as read_text_file does, except for
/// the checks of its text.
std::string read_file_bytes(const std::string& path, std::size_t largest = std::size_t{2} << 30);

/// The greatest depth of nesting in JSON that is accepted; the files of Meniscus are less deep. JSON values are copied,
/// compared and written by recursion, so that a file with nothing but brackets would exhaust the stack.
inline constexpr int kDeepestJson = 64;

/// True if arrays and objects are nested more than kDeepestJson levels deep. The text need not be valid JSON.
bool is_nested_too_deep(std::string_view json);

/// Reads a text line by line.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  /// Reads the next line without its line end; false after the last one.
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++number_;
    return true;
  }

  std::size_t number() const { return number_; }  ///< of the line last read, from 1
  bool only_blanks_left() const { return rest_.find_first_not_of(" \t\n") == std::string_view::npos; }
  std::size_t bytes_left() const { return rest_.size(); }  ///< after the line last read

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// Returns the text without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// Removes the first field from a line and returns it; empty if there is none. Fields are separated by blanks and tabs.
std::string_view take_field(std::string_view& rest);

/// Returns the fields of a line. After `most` fields the rest of the line is ignored.
std::vector<std::string_view> fields_of(std::string_view line, std::size_t most = 64);

/// Returns the cells of a line of CSV, without blanks at both ends. A cell in double quotes may contain separators, and
/// "" in it means one quote.
std::vector<std::string> csv_cells_of(std::string_view line, char separator = ',');

}  // namespace meniscus
