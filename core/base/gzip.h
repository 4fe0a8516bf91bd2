// SPDX-License-Identifier: BSD-3-Clause
// Unpacking of gzip data, and errors for files that are too large or packed by other programs.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {

/// Unpacks all members of gzip data and returns their bytes. path: the file, for messages. Throws InputError if the
/// data is damaged, cut short or followed by other bytes, or if this build has no zlib. Throws CapacityError for more
/// than `largest` bytes.
std::string unpack_gzip(const std::string& path, const std::string& packed, std::size_t largest);

/// Throws CapacityError for a file of more than `largest` bytes.
[[noreturn]] inline void refuse_too_large(const std::string& path, std::size_t largest) {
  throw CapacityError(
      fmt::format("{}: holds more than {} bytes, more than this program reads", path, with_thousands(largest)));
}

/// Throws InputError if the bytes begin like a file of another packer. The message has the command that unpacks it.
inline void refuse_packed(const std::string& path, std::string_view bytes) {
  struct Packer {
    std::string_view magic;
    const char *name, *unpack;
    std::size_t at = 0;
  };
  constexpr std::array<Packer, 7> kPackers{{{"BZh", "bzip2", "bzip2 -dk"},
                                            {"\3757zXZ", "xz", "xz -dk"},
                                            {"\x28\xb5\x2f\xfd", "zstd", "zstd -d"},
                                            {"PK\x03\x04", "zip", "unzip"},
                                            {"\x1f\x9d", "compress", "gzip -dk"},
                                            {"\x04\x22\x4d\x18", "lz4", "lz4 -dk"},
                                            {"ustar", "tar", "tar -xf", 257}}};
  for (const auto& [magic, name, unpack, at] : kPackers)
    if (bytes.size() >= at && bytes.substr(at).starts_with(magic))
      throw InputError(
          path, 0,
          fmt::format("is packed with {}; only gzip is read, unpack it first: {} {}", name, unpack, shell_word(path)));
}

}  // namespace meniscus
