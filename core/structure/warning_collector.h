// SPDX-License-Identifier: BSD-3-Clause
// Gathers the cases of one kind of oddity in a file, for one warning that sums them up.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

struct Warning;

class WarningCollector {
 public:
  /// One more case: an atom in this line of the file and the text that is odd about it, or words for the two.
  void add(std::size_t line, std::string_view text);
  void add(std::string words) { cases_.push_back(std::move(words)); }
  /// Appends nothing without cases; else "12 atoms have <what> (first: line 3, 'text')" with a detail for each.
  void warn(std::vector<Warning>& warnings, const char* what);

 private:
  std::vector<std::string> cases_;
};

}  // namespace meniscus
