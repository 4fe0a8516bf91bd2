// SPDX-License-Identifier: BSD-3-Clause
// Which known word a wrong one is nearest to.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace meniscus {

/// Letters (bytes) to change, insert or drop to get from one word to the other (Levenshtein 1966).
std::size_t letters_apart(std::string_view from, std::string_view to);

/// The first of the nearest known words of more than two letters, if at most two letters differ, and of short words at
/// most half; else empty.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known);

}  // namespace meniscus
