// SPDX-License-Identifier: BSD-3-Clause
// Files packed with gzip, and the error for files that are too large.
#pragma once

#include <cstddef>
#include <string>

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

}  // namespace meniscus
