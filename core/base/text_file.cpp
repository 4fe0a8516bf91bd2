// SPDX-License-Identifier: BSD-3-Clause
// Reads and vets text files, and splits them into lines, fields and comma-separated cells.
#include "core/base/text_file.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/gzip.h"
#include "core/base/text.h"
#include "core/base/uninterrupted.h"

namespace meniscus {
namespace {

constexpr std::size_t kLongestLine = std::size_t{1} << 20;
constexpr std::size_t kTail = 4096;  // bytes before the end, to tell appending from writing anew

[[noreturn]] void unreadable(const std::string& path) {
  throw InputError(path, 0, std::string("cannot be read: ") + std::strerror(errno));
}

/// An open file. The descriptor is closed with it.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path)
      : path_(path), descriptor_(uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); })) {
    if (descriptor_ < 0) unreadable(path_);
  }
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  struct stat status() const {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) unreadable(path_);
    return status;
  }

  /// These bytes of the file, fewer where it ends before.
  std::string read(std::size_t offset, std::size_t count) const {
    std::string bytes(count, '\0');
    std::size_t filled = 0;
    while (filled < count) {
      const ssize_t got = uninterrupted([&] {
        return ::pread(descriptor_, bytes.data() + filled, count - filled, static_cast<off_t>(offset + filled));
      });
      if (got < 0) unreadable(path_);
      if (got == 0) break;
      filled += static_cast<std::size_t>(got);
    }
    bytes.resize(filled);
    return bytes;
  }

 private:
  const std::string& path_;
  int descriptor_;
};

bool same_time(const timespec& a, const timespec& b) { return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec; }

/// Is what was read what the file held when it was opened? Bytes appended since then do not matter.
bool is_snapshot(const OpenFile& file, const struct stat& opened, std::string_view bytes) {
  if (bytes.size() != static_cast<std::size_t>(opened.st_size)) return false;
  const struct stat now = file.status();
  if (now.st_size == opened.st_size) return same_time(now.st_mtim, opened.st_mtim);
  const std::string_view tail = bytes.substr(bytes.size() - std::min(bytes.size(), kTail));
  return now.st_size > opened.st_size && file.read(bytes.size() - tail.size(), tail.size()) == tail;
}

std::string read_bytes(const std::string& path, std::size_t largest) {
  struct stat status {};
  // Asked before opening, because to open a pipe waits for somebody who writes to it.
  if (::stat(path.c_str(), &status) != 0) unreadable(path);
  if (S_ISDIR(status.st_mode)) throw InputError(path, 0, "is a folder; give the name of a molecule file");
  if (!S_ISREG(status.st_mode))
    throw InputError(path, 0, "is a pipe or device; save it as a file first, or give - to read standard input");
  const OpenFile file(path);
  status = file.status();
  if (static_cast<std::size_t>(status.st_size) > largest) refuse_too_large(path, largest);
  std::string bytes = file.read(0, static_cast<std::size_t>(status.st_size));
  if (!is_snapshot(file, status, bytes))
    throw InputError(path, 0, "was changed while it was read; run again once it is complete");
  if (bytes.empty()) throw InputError(path, 0, "is empty: no atoms");
  return bytes;
}

std::string read_standard_input(const std::string& path, std::size_t largest) {
  std::string bytes;
  std::string chunk(std::size_t{1} << 16, '\0');
  while (true) {
    const ssize_t count = uninterrupted([&] { return ::read(STDIN_FILENO, chunk.data(), chunk.size()); });
    if (count < 0) unreadable(path);
    if (count == 0) break;
    bytes.append(chunk, 0, static_cast<std::size_t>(count));
    if (bytes.size() > largest) refuse_too_large(path, largest);
  }
  if (bytes.empty()) throw InputError(path, 0, "is empty: no atoms");
  return bytes;
}

void refuse_other_containers(const std::string& path, std::string_view bytes) {
  constexpr std::pair<std::string_view, const char*> kContainers[] = {{"BZh", "bzip2"},
                                                                      {"\xfd"
                                                                       "7zXZ",
                                                                       "xz"},
                                                                      {"\x28\xb5\x2f\xfd", "zstd"},
                                                                      {"PK\x03\x04", "zip"}};
  for (const auto& [magic, name] : kContainers) {
    if (bytes.starts_with(magic))
      throw InputError(path, 0, fmt::format("is packed with {}; only gzip is read, unpack it first", name));
  }
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
    throw InputError(path, 0, "is UTF-16 text; save it as UTF-8 or ASCII");
  }
}

void unify_line_ends(std::string& text) {
  if (text.find('\r') == std::string::npos) return;
  std::size_t out = 0;
  for (std::size_t in = 0; in < text.size(); ++in) {
    if (text[in] == '\r') {
      if (in + 1 < text.size() && text[in + 1] == '\n') continue;
      text[out++] = '\n';
    } else {
      text[out++] = text[in];
    }
  }
  text.resize(out);
}

void refuse_long_lines(const std::string& path, std::string_view text) {
  std::size_t line = 1;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > kLongestLine) {
      throw CapacityError(fmt::format("{}:{}: the line has {} bytes, more than {}; is this a molecule file?", path,
                                      line, with_thousands(end - begin), with_thousands(kLongestLine)));
    }
    begin = end + 1;
  }
}

}  // namespace

std::string read_file_bytes(const std::string& given, std::size_t largest) {
  const bool standard_input = given == "-";
  const std::string path = standard_input ? "standard input" : given;
  std::string bytes = standard_input ? read_standard_input(path, largest) : read_bytes(path, largest);
  if (bytes.starts_with("\x1f\x8b")) bytes = unpack_gzip(path, bytes, largest);
  return bytes;
}

TextFile read_text_file(const std::string& path, std::size_t largest) {
  return text_of_bytes(path == "-" ? "standard input" : path, read_file_bytes(path, largest));
}

TextFile text_of_bytes(const std::string& path, std::string bytes) {
  TextFile file{path, std::move(bytes)};
  std::string& text = file.text;
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  refuse_other_containers(path, text);
  if (const std::size_t nul = text.find('\0'); nul != std::string::npos) {
    throw InputError(path, 0, fmt::format("is binary, not text: byte {} is zero; molecule files are text", nul));
  }
  unify_line_ends(text);
  if (text.find_first_not_of(" \t\n\v\f") == std::string::npos) throw InputError(path, 0, "is empty: no atoms");
  refuse_long_lines(path, text);
  return file;
}

bool is_nested_too_deep(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t n = 0; n < json.size(); ++n) {
    const char c = json[n];
    if (in_string) {
      if (c == '\\') ++n;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepestJson) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

std::string_view take_field(std::string_view& rest) {
  const std::size_t first = rest.find_first_not_of(" \t");
  if (first == std::string_view::npos) {
    rest = {};
    return {};
  }
  rest.remove_prefix(first);
  const std::string_view field = rest.substr(0, rest.find_first_of(" \t"));
  rest.remove_prefix(field.size());
  return field;
}

std::vector<std::string_view> fields_of(std::string_view line, std::size_t most) {
  std::vector<std::string_view> fields;
  while (fields.size() < most) {
    const std::string_view field = take_field(line);
    if (field.empty()) break;
    fields.push_back(field);
  }
  return fields;
}

std::vector<std::string> csv_cells_of(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t n = 0; n < line.size(); ++n) {
    const bool twice = quoted && line[n] == '"' && n + 1 < line.size() && line[n + 1] == '"';
    if (line[n] == '"' && !twice)
      quoted = !quoted;
    else if (line[n] == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[n];
    n += twice ? 1 : 0;
  }
  for (std::string& cell : cells) cell = std::string(trimmed(cell));
  return cells;
}

}  // namespace meniscus
