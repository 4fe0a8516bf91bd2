// SPDX-License-Identifier: BSD-3-Clause
// Files packed with gzip, and the errors for files that are too large or packed by other programs.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {

/// Unpacks all members. path: of the file, for messages. Throws InputError where the data is damaged, cut short or
/// followed by other bytes, and where this build has no zlib; CapacityError beyond `largest` bytes.
std::string unpack_gzip(const std::string& path, const std::string& packed, std::size_t largest);

[[noreturn]] inline void refuse_too_large(const std::string& path, std::size_t largest) {
  throw CapacityError(
      fmt::format("{}: holds more than {} bytes, more than this program reads", path, with_thousands(largest)));
}

/// Throws InputError for bytes that begin as other packers write them, with the command that unpacks the file.
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
