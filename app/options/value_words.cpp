// SPDX-License-Identifier: BSD-3-Clause
// The checks that need no type of their own.
#include "app/options/value_words.h"

namespace meniscus {

CLI::Validator proposes(const std::vector<std::string>& words) {
  return CLI::Validator([](std::string&) { return std::string(); }, "", CLI::detail::join(words, "|"));
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  CLI::Validator check = CLI::IsMember(words).description("");
  check.name(CLI::detail::join(words, "|"));
  return check;
}

}  // namespace meniscus
