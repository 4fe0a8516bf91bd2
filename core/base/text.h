// SPDX-License-Identifier: BSD-3-Clause
// Small pieces of message text: escaped quotes from foreign files, and counts as people write them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace meniscus {

/// The text with control characters as \xNN, so that a foreign file cannot steer a terminal. UTF-8 passes.
std::string escaped(std::string_view text);

/// 'text' in quotes, escaped, at most 40 bytes of it.
std::string in_quotes(std::string_view text);

/// 5469 -> "5,469".
std::string with_thousands(std::uint64_t count);

}  // namespace meniscus
