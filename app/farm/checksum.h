// SPDX-License-Identifier: BSD-3-Clause
// SHA-256 of texts and files, as 64 hexadecimal digits.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace meniscus::farm {

/// FIPS 180-4, by OpenSSL.
std::string sha256(std::string_view bytes);

/// Of a file's content. Throws InputError: missing, no regular file, cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace meniscus::farm
