// SPDX-License-Identifier: BSD-3-Clause
// Texts of messages and files: escaped quotes, counts as people write them, options as each door spells them, the
// nearest known word, templates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// The text with the bytes of control characters (is_control() in utf8.h) and those that are not UTF-8 as \xNN, so that
/// a foreign file cannot steer a terminal, nor turn words around. All other UTF-8 passes.
std::string escaped(std::string_view text);

/// At most `bytes` bytes of the text, escaped, and "..." in place of the rest.
std::string shortened(std::string_view text, std::size_t bytes);

/// 'text' in quotes, escaped, at most 40 bytes of it.
std::string in_quotes(std::string_view text);

/// The text in lines of at most `width` letters, broken at blanks; all but the first begin with `indent` blanks, which
/// count for no width. A longer word is in a line of its own.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

/// 5469 -> "5,469".
std::string with_thousands(std::uint64_t count);

/// One word of a POSIX shell, whatever the text holds.
std::string shell_word(std::string_view text);

/// Text between the tags of XML and HTML, or in a double-quoted attribute. Control characters are left out but for new
/// lines and tabs, and U+FFFD stands for bytes that are not UTF-8.
std::string markup_text(std::string_view text);

/// Three bytes as four letters (RFC 4648).
std::string base64(std::string_view bytes);

/// Two lines: the text, and a caret under byte `position` of it (at most its size). Of a long text only a window around
/// the place is shown; control characters are escaped, and UTF-8 counts by character.
std::string pointed_at(std::string_view text, std::size_t position);

/// How an option is written, "keep-water" by its name: "--keep-water", unless the door has another spelling.
std::string option_name(std::string_view name);

/// The spelling of this door, which is set before anything else is called.
using OptionSpelling = std::string (*)(std::string_view name);
void spell_options(OptionSpelling spelling);

/// The first of the nearest known words of more than two letters, if at most two letters differ, and of short words at
/// most half; else empty.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known);

/// A file that the build has made part of the program.
struct TemplateFile {
  std::string_view path;
  std::string_view text;
};

/// The text of the file of this path, which is there.
std::string_view template_text(std::span<const TemplateFile> files, std::string_view path);

/// What stands for "@NAME@".
struct Filling {
  std::string name, text;
};

/// A template with each "@NAME@" that has a filling replaced. Texts put in are not searched again.
std::string filled(std::string_view text, const std::vector<Filling>& fillings);

}  // namespace meniscus
