// SPDX-License-Identifier: BSD-3-Clause
// Paths that really stay inside the folder of a bundle, whatever links others have put there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace meniscus::farm {

/// Whether the text is a relative path of plain names: letters, digits, "._-", none of them "." or ".." or hidden.
bool is_inner_path(const std::string& text);

/// Whether it is an absolute path of such names.
bool is_plain_absolute_path(const std::string& text);

/// What lies at a path, no link followed.
enum class Entry { nothing, file, folder };

/// Looks at folder / inner, part by part. Throws InputError if a part of `inner` is a symbolic link, or what lies there
/// is neither a regular file nor a folder. Who may write into the folder while it is looked at is trusted.
Entry inner_entry(const std::filesystem::path& folder, const std::filesystem::path& inner);

/// The whole content of a regular file; nothing if there is none. Throws InputError: as above, a folder, longer than
/// `most` bytes, or it cannot be read.
std::optional<std::string> inner_text(const std::filesystem::path& folder, const std::filesystem::path& inner,
                                      std::size_t most);

/// Nanoseconds, by the clock of the file system, which is that of a server where there is one.
using FileTime = std::int64_t;

/// When a file was last written, as its server knows it now; nothing if there is none. Follows no link.
std::optional<FileTime> modified(const std::filesystem::path& path);

/// Throws InputError unless all folders in which work on a bundle puts files are folders, or not there yet, and those
/// in scene/ are regular files.
void check_places(const std::filesystem::path& folder);

}  // namespace meniscus::farm
