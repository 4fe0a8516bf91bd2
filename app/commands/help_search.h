// SPDX-License-Identifier: BSD-3-Clause
// Searches the manual and the options of all commands for words.
#pragma once

#include <string>
#include <string_view>

#include "app/options/command_tree.h"

namespace meniscus {

/// Returns the commands, options and pages of the manual that speak of all words of a query, the best first, as text
/// for people. A word also stands for its synonyms in other programs ("movie" for "film"). The result is empty if
/// nothing is found.
std::string help_about(const CommandEntry& program, std::string_view query);

}  // namespace meniscus
