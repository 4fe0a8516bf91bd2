// SPDX-License-Identifier: BSD-3-Clause
// Text files: reading one whole, also from gzip data, with bounds on its cost, splitting it into lines, fields and
// cells, and parsing numbers strictly.
#pragma once

#include <array>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {

/// The text of a file, with LF line ends and without byte-order mark. It is not empty and has no NUL bytes.
struct TextFile {
  std::string path;  ///< path as the user gave it, or "standard input"
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

/// Reads a text or a file line by line.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}
  explicit LineReader(const TextFile& file) : rest_(file.text), path_(file.path) {}

  /// Reads the next line without its line end; false after the last one.
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++number_;
    return true;
  }

  std::size_t number() const { return number_; }  ///< number of the line last read, from 1
  bool only_blanks_left() const { return rest_.find_first_not_of(" \t\n") == std::string_view::npos; }
  std::size_t bytes_left() const { return rest_.size(); }  ///< bytes after the line last read

  /// Returns the error of the line of the file that was last read, with a text for fmt::format().
  template <typename... Values>
  InputError error(fmt::format_string<Values...> text, Values&&... values) const {
    return {std::string(path_), number_, fmt::format(text, std::forward<Values>(values)...)};
  }

 private:
  std::string_view rest_, path_;
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

/// Throws InputError: the number of atoms in this line is larger than the number of atoms in the file.
[[noreturn]] void refuse_short_frame(const TextFile& file, std::size_t line, std::size_t count, std::size_t found);

/// The largest coordinate that readers accept, in Å (10 µm). A file with larger ones is broken or uses other units.
inline constexpr double kLargestCoordinate = 1e5;

/// Returns a coordinate in Å. Throws InputError if it is beyond kLargestCoordinate.
double check_extent(const TextFile& file, std::size_t line, char axis, double coordinate);

/// Parses a coordinate field in Å. Throws InputError with file, line, axis and text if it is not finite or too large.
double parse_coordinate(const TextFile& file, std::size_t line, char axis, std::string_view field);

/// Parses a coordinate field and multiplies it by `unit` (Å). False where parse_coordinate would throw.
bool try_parse_coordinate(std::string_view field, double unit, double& coordinate);

/// Parses a radius field in Å. Throws InputError if it is not a number from 0 to 1,000. columns: the fields of a line,
/// for messages.
double parse_radius(const TextFile& file, std::size_t line, std::string_view field, std::string_view columns);

/// Parses a field as a finite number. Blanks around the number are allowed. False if the field is anything else.
bool parse_number(std::string_view field, double& number);

/// Parses a field as a whole number. Blanks around the number are allowed. False if the field is anything else.
bool parse_whole_number(std::string_view field, std::int64_t& number);

/// The largest radius that readers accept, in Å.
inline constexpr double kLargestRadius = 1000.0;

/// Parses a field as parse_number does, and rounds to single precision. False if the number is beyond its range, too.
bool parse_single(std::string_view field, float& number);

/// Unpacks all members of gzip data and returns their bytes. path: the file, for messages. Throws InputError if the
/// data is damaged, cut short or followed by other bytes, or if this build has no zlib. Throws CapacityError for more
/// than `largest` bytes.
std::string unpack_gzip(const std::string& path, const std::string& packed, std::size_t largest);

/// Throws InputError if the bytes begin like a file of another packer. The message has the command that unpacks it.
inline void refuse_packed(const std::string& path, std::string_view bytes) {
  struct Packer {
    std::string_view magic;
    const char *name, *unpack;
    std::size_t at = 0;
  };
  constexpr std::array<Packer, 7> kPackers{{{"BZh", "bzip2", "bzip2 -dk"},
                                            {"\3757zXZ", "xz", "xz -dk"},
                                            {"\x28\xb5\x2f\xfd", "zstd", "zstd -d"},
                                            {"PK\x03\x04", "zip", "unzip"},
                                            {"\x1f\x9d", "compress", "gzip -dk"},
                                            {"\x04\x22\x4d\x18", "lz4", "lz4 -dk"},
                                            {"ustar", "tar", "tar -xf", 257}}};
  for (const auto& [magic, name, unpack, at] : kPackers)
    if (bytes.size() >= at && bytes.substr(at).starts_with(magic))
      throw InputError(path, 0, "is packed with {}; only gzip is read, unpack it first: {} {}", name, unpack,
                       shell_word(path));
}

}  // namespace meniscus
