// SPDX-License-Identifier: BSD-3-Clause
// Decodes UTF-8, escapes and wraps texts, spells options in messages, finds nearest words, and fills templates.
#include "core/base/text.h"

#include <algorithm>
#include <cassert>

namespace meniscus {

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >> 5 == 6 ? 2 : lead >> 4 == 14 ? 3 : lead >> 3 == 30 ? 4 : 0;
  if (bytes == 0 || bytes > text.size()) return {};
  char32_t code = lead & (0x7fu >> bytes);
  for (std::size_t n = 1; n < bytes; ++n) {
    if (byte(n) >> 6 != 2) return {};
    code = code << 6 | (byte(n) & 0x3fu);
  }
  constexpr char32_t kLeast[] = {0x80, 0x800, 0x10000};  // the least codes that need 2, 3 and 4 bytes
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  if (code < kLeast[bytes - 2] || is_surrogate || code > 0x10ffff) return {};
  return {code, bytes};
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t bytes = first_character(text).bytes;
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

bool is_control(char32_t code) {
  const auto is_within = [code](char32_t first, char32_t last) { return code >= first && code <= last; };
  return code < 0x20 || is_within(0x7f, 0x9f) || code == 0x61c || is_within(0x200e, 0x200f) ||
         is_within(0x2028, 0x202e) || is_within(0x2066, 0x2069);
}

std::string escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::string_view bytes = text.substr(0, std::max<std::size_t>(character.bytes, 1));
    if (character.bytes > 0 && !is_control(character.code))
      result += bytes;
    else
      for (const char byte : bytes) result += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
    text.remove_prefix(bytes.size());
  }
  return result;
}

std::string shortened(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return escaped(text);
  while (bytes > 0 && (text[bytes] & 0xc0) == 0x80) --bytes;  // never splits a character
  return escaped(text.substr(0, bytes)) + "...";
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  return fmt::format("'{}'", shortened(text, kLongest));
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string lines;
  std::size_t used = 0;
  while (!text.empty()) {
    const std::size_t blank = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, blank);
    text.remove_prefix(std::min(text.size(), blank + 1));
    if (word.empty()) continue;
    const auto letters =
        static_cast<std::size_t>(std::count_if(word.begin(), word.end(), [](char c) { return (c & 0xc0) != 0x80; }));
    if (used > 0 && used + 1 + letters > width) {
      lines.append("\n").append(indent, ' ');
      used = 0;
    }
    if (used > 0) lines += ' ';
    lines += word;
    used += letters + (used > 0 ? 1 : 0);
  }
  return lines;
}

std::string with_thousands(std::uint64_t count) {
  const std::string digits = std::to_string(count);
  std::string grouped;
  for (std::size_t n = 0; n < digits.size(); ++n) {
    if (n > 0 && (digits.size() - n) % 3 == 0) grouped += ',';
    grouped += digits[n];
  }
  return grouped;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

std::string upper_case(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) c = 'a' <= c && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return upper;
}

std::string shell_word(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

std::string markup_text(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::string_view bytes = text.substr(0, std::max<std::size_t>(character.bytes, 1));
    if (bytes == "&")
      result += "&amp;";
    else if (bytes == "<")
      result += "&lt;";
    else if (bytes == ">")
      result += "&gt;";
    else if (bytes == "\"")
      result += "&quot;";
    else if (character.bytes == 0)
      result += "\xef\xbf\xbd";
    else if (!is_control(character.code) || bytes == "\n" || bytes == "\t")
      result += bytes;
    text.remove_prefix(bytes.size());
  }
  return result;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t n) -> std::uint32_t {
    return n < bytes.size() ? static_cast<unsigned char>(bytes[n]) : 0;
  };
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    const std::uint32_t word = byte(n) << 16 | byte(n + 1) << 8 | byte(n + 2);
    for (std::size_t k = 0; k < 4; ++k) text += n + k > bytes.size() ? '=' : kLetters[word >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string pointed_at(std::string_view text, std::size_t position) {
  constexpr std::size_t kBefore = 50, kAfter = 30;
  // True inside a UTF-8 character.
  const auto continues = [&](std::size_t n) { return n < text.size() && (text[n] & 0xc0) == 0x80; };
  while (position > 0 && continues(position)) --position;  // the caret is under a whole character
  std::size_t first = position > kBefore ? position - kBefore : 0;
  std::size_t last = std::min(text.size(), position + kAfter);
  while (first < position && continues(first)) ++first;
  while (continues(last)) ++last;
  const std::string before = fmt::format("{}{}", first > 0 ? "..." : "", escaped(text.substr(first, position - first)));
  const std::string after =
      fmt::format("{}{}", escaped(text.substr(position, last - position)), last < text.size() ? "..." : "");
  const auto width = std::count_if(before.begin(), before.end(), [](char c) { return (c & 0xc0) != 0x80; });
  return fmt::format("{}{}\n{:{}}^", before, after, "", width);
}

namespace {

std::string on_command_line(std::string_view name) { return "--" + std::string(name); }

OptionSpelling current_spelling = on_command_line;

/// Returns the edit distance of two words: the number of bytes to change, insert or drop (V. I. Levenshtein 1966).
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  for (std::size_t j = 0; j <= to.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t changed = diagonal + (from[i - 1] == to[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[to.size()];
}

}  // namespace

std::string option_name(std::string_view name) { return current_spelling(name); }

void spell_options(OptionSpelling spelling) { current_spelling = spelling; }

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known) {
  constexpr std::size_t kLongestWord = 40;
  if (word.size() > kLongestWord) return {};
  std::size_t fewest = std::min<std::size_t>(3, (word.size() + 1) / 2);
  std::string_view nearest;
  for (const std::string_view other : known) {
    const std::size_t distance = edit_distance(word, other);
    if (other.size() <= 2 || distance >= fewest) continue;
    fewest = distance;
    nearest = other;
  }
  return nearest;
}

std::string_view template_text(std::span<const TemplateFile> files, std::string_view path) {
  const auto found = std::ranges::find(files, path, &TemplateFile::path);
  assert(found != files.end());
  return found->text;
}

std::string filled(std::string_view text, const std::vector<Filling>& fillings) {
  std::string result;
  while (true) {
    const std::size_t begin = text.find('@');
    result.append(text.substr(0, begin));
    if (begin == std::string_view::npos) return result;
    text.remove_prefix(begin);
    const auto filling =
        std::ranges::find_if(fillings, [&](const Filling& f) { return text.starts_with("@" + f.name + "@"); });
    const bool is_mark = filling != fillings.end();
    result.append(is_mark ? filling->text : "@");
    text.remove_prefix(is_mark ? filling->name.size() + 2 : 1);
  }
}

std::string with_options(std::string_view text) {
  std::string spelled;
  for (std::size_t begin; (begin = text.find('@')) != std::string_view::npos;) {
    spelled += text.substr(0, begin);
    text.remove_prefix(begin + 1);
    const std::size_t end = text.find('@');
    spelled += option_name(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return spelled.append(text);
}

}  // namespace meniscus
