// SPDX-License-Identifier: BSD-3-Clause
// Checks that know the words of an option's value: what the completion of shells proposes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace meniscus {

/// Lets any value pass, and proposes these. The name of a check is where command_tree() finds its words.
CLI::Validator proposes(const std::vector<std::string>& words);

/// Takes one of these words, and nothing else.
CLI::Validator one_of(const std::vector<std::string>& words);

/// The same, for what it means.
template <class Value>
CLI::Validator one_of(const std::map<std::string, Value>& meanings) {
  std::vector<std::string> words;
  words.reserve(meanings.size());
  for (const auto& [word, meaning] : meanings) words.push_back(word);
  CLI::Validator check = CLI::CheckedTransformer(meanings).description("");
  check.name(CLI::detail::join(words, "|"));
  return check;
}

}  // namespace meniscus
