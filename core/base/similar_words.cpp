// SPDX-License-Identifier: BSD-3-Clause
// Edit distance by one row of its table.
#include "core/base/similar_words.h"

#include <algorithm>
#include <vector>

namespace meniscus {

std::size_t letters_apart(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  for (std::size_t j = 0; j <= to.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t changed = diagonal + (from[i - 1] == to[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[to.size()];
}

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known) {
  constexpr std::size_t kLongestWord = 40;
  if (word.size() > kLongestWord) return {};
  std::size_t fewest = std::min<std::size_t>(3, (word.size() + 1) / 2);
  std::string_view nearest;
  for (const std::string_view other : known) {
    const std::size_t apart = letters_apart(word, other);
    if (other.size() <= 2 || apart >= fewest) continue;
    fewest = apart;
    nearest = other;
  }
  return nearest;
}

}  // namespace meniscus
