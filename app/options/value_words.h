// SPDX-License-Identifier: BSD-3-Clause
// Checks that know the words of an option's value: what the completion of shells proposes.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace meniscus {

/// Lets any value pass, and proposes these. The name of a check is where command_tree() finds its words.
CLI::Validator proposes(const std::vector<std::string>& words);

/// Takes one of these words, and nothing else.
CLI::Validator one_of(const std::vector<std::string>& words);

}  // namespace meniscus
