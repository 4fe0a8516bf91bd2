// SPDX-License-Identifier: BSD-3-Clause
// Words for the oddities of a file.
#include "core/structure/warning_collector.h"

#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/structure/structure.h"

namespace meniscus {

void WarningCollector::add(std::size_t line, std::string_view text) {
  cases_.push_back(fmt::format("line {}, {}", line, in_quotes(text)));
}

void WarningCollector::warn(std::vector<Warning>& warnings, const char* what) {
  if (cases_.empty()) return;
  std::string sentence = fmt::format("{} {} {} (first: {})", with_thousands(cases_.size()),
                                     cases_.size() == 1 ? "atom has" : "atoms have", what, cases_.front());
  warnings.emplace_back(std::move(sentence), std::move(cases_));
  cases_.clear();
}

}  // namespace meniscus
