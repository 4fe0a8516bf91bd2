// SPDX-License-Identifier: BSD-3-Clause
// Fonts that were made part of the library when it was built.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace meniscus {

/// A font file in memory. It counts as installed, and comes before a file of this name in the system.
struct BuiltInFont {
  std::string_view name, bytes;
};

/// Returns the files of Liberation Sans, regular and bold; none if they were missing when the library was built.
std::span<const BuiltInFont> built_in_fonts();

/// Returns the bytes of a font by FontProgram::file, which is the path of a file, or "built-in:" and the name of a
/// built-in font. Throws InputError if the file cannot be read.
std::string font_bytes(const std::string& file);

}  // namespace meniscus
