// SPDX-License-Identifier: BSD-3-Clause
// Texts of messages and files: UTF-8, escaped quotes, line breaks, numbers with separators, names of options, the
// nearest known word, and templates.
//
// Core writes "@NAME@", and each interface (command line, library) spells it in its own way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace meniscus {

/// A character and its number of bytes in UTF-8.
struct Character {
  char32_t code = 0;
  std::size_t bytes = 0;
};

/// Decodes the first character of a text that is not empty. It has 0 bytes if the text does not begin with UTF-8 (RFC
/// 3629).
Character first_character(std::string_view text);

/// True if the whole text is UTF-8.
bool is_utf8(std::string_view text);

/// True if a character is invisible but controls a terminal or the display of other characters: control characters of
/// ASCII and U+0080 to U+009F, marks of direction (Unicode's Bidi_Control), and separators of lines and paragraphs.
bool is_control(char32_t code);

/// Returns the text with control characters (is_control()) and bytes that are not UTF-8 written as \xNN. So a text from
/// a file cannot control a terminal or reverse the direction of words. All other UTF-8 is unchanged.
std::string escaped(std::string_view text);

/// Returns the text escaped, cut after at most `bytes` bytes, with "..." in place of the rest.
std::string shortened(std::string_view text, std::size_t bytes);

/// Returns the text in single quotes, escaped and cut after 40 bytes.
std::string in_quotes(std::string_view text);

/// Returns the text broken at blanks into lines of at most `width` letters. All lines but the first begin with `indent`
/// blanks, which do not count for the width. A longer word has a line of its own.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

/// Returns a number with separators: 5469 becomes "5,469".
std::string with_thousands(std::uint64_t count);

/// Return the text with all letters of ASCII in lower or in upper case.
std::string lower_case(std::string_view text);
std::string upper_case(std::string_view text);

/// Returns the text quoted as one word of a POSIX shell. Any text is allowed.
std::string shell_word(std::string_view text);

/// Returns the text escaped for use between tags of XML and HTML or in a double-quoted attribute. Control characters
/// other than line feeds and tabs are left out. Bytes that are not UTF-8 become U+FFFD.
std::string markup_text(std::string_view text);

/// Encodes bytes as base64: four letters for every three bytes (RFC 4648).
std::string base64(std::string_view bytes);

/// Returns two lines: the text, and a caret under byte `position` of it, which is at most its size. A long text is
/// shortened to a window around the position. Control characters are escaped, and UTF-8 counts by character.
std::string pointed_at(std::string_view text, std::size_t position);

/// Returns the spelling of an option by its name: by default with two hyphens before it, else as the function that
/// spell_options() has set returns it.
std::string option_name(std::string_view name);

/// A function that spells options, and the call that sets it for this interface, before anything else.
using OptionSpelling = std::string (*)(std::string_view name);
void spell_options(OptionSpelling spelling);

/// Returns the first of the nearest known words. At most two letters may differ, and at most half of the letters of a
/// short word. Known words of one or two letters are ignored. The result is empty if there is no such word.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known);

/// A file that the build has compiled into the program.
struct TemplateFile {
  std::string_view path;
  std::string_view text;
};

/// Returns the text of the file of this path, which must be among the files.
std::string_view template_text(std::span<const TemplateFile> files, std::string_view path);

/// The text that replaces "@NAME@" in a template.
struct Filling {
  std::string name, text;
};

/// Returns a template with each "@NAME@" replaced by its filling. Names without a filling stay. Inserted texts are not
/// searched again.
std::string filled(std::string_view text, const std::vector<Filling>& fillings);

/// Returns the text with each "@NAME@" and "@NAME VALUE@" spelled as this interface writes an option and its value
/// (option_name()). For example "@frames all@" becomes "frames=all" in libraries.
std::string with_options(std::string_view text);

/// Formats such a text by fmt::format(). Options are replaced in the text only, not in the values.
template <typename... Values>
std::string message(fmt::format_string<Values...> text, Values&&... values) {
  const fmt::string_view form = text;
  return fmt::vformat(with_options({form.data(), form.size()}), fmt::make_format_args(values...));
}

}  // namespace meniscus
