// SPDX-License-Identifier: BSD-3-Clause
// Files packed with gzip.
#pragma once

#include <cstddef>
#include <string>

namespace meniscus {

/// Unpacks all members. path: of the file, for messages. Throws InputError where the data is damaged, cut short or
/// followed by other bytes, and where this build has no zlib; CapacityError beyond `largest` bytes.
std::string unpack_gzip(const std::string& path, const std::string& packed, std::size_t largest);

}  // namespace meniscus
