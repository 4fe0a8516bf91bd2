// SPDX-License-Identifier: BSD-3-Clause
// A whole text file in memory, unpacked if gzipped, with bounds on what a hostile file may cost.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

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

/// Do arrays and objects stand in each other more than kDeepestJson levels deep? The text need not be JSON.
bool is_nested_too_deep(std::string_view json);

}  // namespace meniscus
