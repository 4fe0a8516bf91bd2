// SPDX-License-Identifier: BSD-3-Clause
// Removes from PNG files what renderers write about themselves and the date.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace meniscus::farm {

/// The file without its chunks of time and text (tIME, tEXt, zTXt, iTXt; PNG, W3C 2003), so that the same picture is
/// the same file. Pixels and colour space stay as they are, to the byte. Throws RunError (kExitInput) if it is no whole
/// PNG.
std::string png_without_time(std::string_view file);

/// Whether the file begins as one.
bool is_png(const std::filesystem::path& path);

/// The same done to a file where it lies, whole or not at all. Throws OutputError, too.
void remove_png_time(const std::filesystem::path& path);

}  // namespace meniscus::farm
