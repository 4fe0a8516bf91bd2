// SPDX-License-Identifier: BSD-3-Clause
// Reads and checks text files, splits them into lines, fields and cells, and parses the numbers in them.
#include "core/base/text_file.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <new>

#ifdef MENISCUS_WITH_ZLIB
#include <zlib.h>
#endif

#include "core/base/binary_file.h"
#include "core/base/system_file.h"

namespace meniscus {
namespace {

[[noreturn]] void refuse_too_large(const std::string& path, std::size_t largest) {
  throw CapacityError("{}: holds more than {} bytes, more than this program reads", path, with_thousands(largest));
}

constexpr std::size_t kLongestLine = std::size_t{1} << 20;

std::string read_bytes(const std::string& path, std::size_t largest) {
  BinaryFile file(path, Contents::atoms);
  if (file.size() > largest) refuse_too_large(path, largest);
  std::string bytes(static_cast<std::size_t>(file.size()), '\0');
  file.read(0, std::as_writable_bytes(std::span(bytes)));
  file.check_unchanged();
  return bytes;
}

std::string read_standard_input(const std::string& path, std::size_t largest) {
  std::string bytes;
  std::string chunk(std::size_t{1} << 16, '\0');
  while (true) {
    const std::ptrdiff_t count = system_file::read(0, std::as_writable_bytes(std::span(chunk)).data(), chunk.size());
    if (count < 0) throw InputError(path, 0, std::string("cannot be read: ") + std::strerror(errno));
    if (count == 0) break;
    bytes.append(chunk, 0, static_cast<std::size_t>(count));
    if (bytes.size() > largest) refuse_too_large(path, largest);
  }
  if (bytes.empty()) throw InputError(path, 0, "is empty: no atoms");
  return bytes;
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
    if (end - begin > kLongestLine)
      throw CapacityError("{}:{}: the line has {} bytes, more than {}; is this a molecule file?", path, line,
                          with_thousands(end - begin), with_thousands(kLongestLine));
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
  refuse_packed(path, text);
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError(path, 0, "is UTF-16 text; save it as UTF-8 or ASCII");
  if (const std::size_t nul = text.find('\0'); nul != std::string::npos)
    throw InputError(path, 0, "is binary, not text: byte {} is zero; molecule files are text", nul);
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

std::vector<std::string> csv_cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t n = 0; n < line.size(); ++n) {
    const bool twice = quoted && line[n] == '"' && n + 1 < line.size() && line[n + 1] == '"';
    if (line[n] == '"' && !twice)
      quoted = !quoted;
    else if (line[n] == separator && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[n];
    n += twice ? 1 : 0;
  }
  for (std::string& cell : cells) cell = std::string(trimmed(cell));
  return cells;
}

namespace {

std::string_view without_plus(std::string_view field) {
  field = trimmed(field);
  if (field.size() > 1 && field.front() == '+' && field[1] != '-') field.remove_prefix(1);
  return field;
}

}  // namespace

bool parse_number(std::string_view field, double& number) {
  field = without_plus(field);
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
  return error == std::errc() && end == field.data() + field.size() && std::isfinite(number);
}

bool parse_single(std::string_view field, float& number) {
  double value = 0.0;
  if (!parse_number(field, value) || std::abs(value) > std::numeric_limits<float>::max()) return false;
  number = static_cast<float>(value);
  return true;
}

bool parse_whole_number(std::string_view field, std::int64_t& number) {
  field = without_plus(field);
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
  return error == std::errc() && end == field.data() + field.size();
}

double check_extent(const TextFile& file, std::size_t line, char axis, double coordinate) {
  if (std::abs(coordinate) > kLargestCoordinate)
    throw InputError(file.path, line, "coordinate {} is {} Å, beyond the extent of ±{} Å; is the unit right?", axis,
                     coordinate, kLargestCoordinate);
  return coordinate;
}

void refuse_short_frame(const TextFile& file, std::size_t line, std::size_t count, std::size_t found) {
  throw InputError(file.path, line, "the count says {} atoms, but the file ends after {} of them; is it cut short?",
                   with_thousands(count), with_thousands(found));
}

double parse_coordinate(const TextFile& file, std::size_t line, char axis, std::string_view field) {
  double number = 0.0;
  if (!parse_number(field, number))
    throw InputError(file.path, line, "coordinate {} is {}, not a finite number; correct or remove the atom", axis,
                     in_quotes(field));
  return check_extent(file, line, axis, number);
}

bool try_parse_coordinate(std::string_view field, double unit, double& coordinate) {
  if (!parse_number(field, coordinate)) return false;
  coordinate *= unit;
  return std::abs(coordinate) <= kLargestCoordinate;
}

double parse_radius(const TextFile& file, std::size_t line, std::string_view field, std::string_view columns) {
  double radius = 0.0;
  if (!parse_number(field, radius))
    throw InputError(file.path, line, "radius is {}, not a finite number; the expected line is: {}", in_quotes(field),
                     columns);
  if (radius < 0.0) throw InputError(file.path, line, "radius is {} Å; it must not be negative", radius);
  if (radius > kLargestRadius)
    throw InputError(file.path, line, "radius is {} Å, above the limit of {} Å; is the unit right?", radius,
                     kLargestRadius);
  return radius;
}

#ifdef MENISCUS_WITH_ZLIB

/// zlib checks length and CRC of each member (RFC 1952). Zeros after the last member are accepted: tapes add them.
std::string unpack_gzip(const std::string& path, const std::string& packed, std::size_t largest) {
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 16) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, inflateEnd);
  std::string text;
  std::string chunk(std::size_t{1} << 18, '\0');
  std::size_t next = 0;
  int state = Z_OK;
  while (true) {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + next));
    stream.avail_in = static_cast<uInt>(std::min<std::size_t>(packed.size() - next, std::size_t{1} << 30));
    const uInt given = stream.avail_in;
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = static_cast<uInt>(chunk.size());
    state = inflate(&stream, Z_NO_FLUSH);
    next += given - stream.avail_in;
    text.append(chunk, 0, chunk.size() - stream.avail_out);
    if (text.size() > largest) refuse_too_large(path, largest);
    if (state == Z_STREAM_END) {
      next = std::min(packed.find_first_not_of('\0', next), packed.size());
      if (next == packed.size()) return text;
      if (packed.compare(next, 2, "\x1f\x8b") != 0)
        throw InputError(path, 0, "has other bytes after its gzip data; unpack it by hand");
      inflateReset(&stream);
    } else if (state == Z_BUF_ERROR || (state == Z_OK && next == packed.size() && stream.avail_out > 0)) {
      throw InputError(path, 0, "is cut short: its gzip data ends too early; fetch it again");
    } else if (state != Z_OK) {
      throw InputError(path, 0, "is damaged: gzip says '{}'; fetch it again", stream.msg ? stream.msg : "wrong data");
    }
  }
}

#else

std::string unpack_gzip(const std::string& path, const std::string&, std::size_t) {
  throw InputError(path, 0, "is packed with gzip, and this build was made without zlib; unpack it first");
}

#endif

}  // namespace meniscus
