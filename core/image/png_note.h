// SPDX-License-Identifier: BSD-3-Clause
// Texts that PNG files carry beside their pixels.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace meniscus {

/// Under which key a picture has the scene that it was made of.
inline constexpr std::string_view kSceneNote = "Meniscus scene";

/// Whether a file begins as PNG files do.
bool is_png(const std::filesystem::path& path);

/// The uncompressed text that a PNG file has under this key (iTXt; Portable Network Graphics, W3C 2003, section
/// 11.3.4.5); nothing if it has none or is no PNG file.
std::optional<std::string> png_note(const std::filesystem::path& path, std::string_view key);

}  // namespace meniscus
