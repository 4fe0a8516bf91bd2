// SPDX-License-Identifier: BSD-3-Clause
// From the words behind `farm bundle ... --` to the command that they are.
#pragma once

#include <string>
#include <vector>

#include "app/farm/bundled_command.h"

namespace meniscus::farm {

/// Checks the words by the program's own parser. Throws UsageError: no framed command, wrong options, options that a
/// bundle decides by itself; what the parser's callbacks throw. `result` is filled in place, for options refer to it.
void parse_bundled_command(const std::vector<std::string>& words, BundledCommand& result);

}  // namespace meniscus::farm
