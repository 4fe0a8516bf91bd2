// SPDX-License-Identifier: BSD-3-Clause
// Parses the words after `farm bundle ... --` to a command.
#pragma once

#include <string>
#include <vector>

#include "app/farm/bundled_command.h"

namespace meniscus::farm {

/// Checks the words against the program's own options. Throws UsageError for a command without frames, wrong options,
/// and options that a bundle decides by itself; RequestError for options that a bundle does not have; and the errors of
/// taking options.
BundledCommand parse_bundled_command(const std::vector<std::string>& words);

}  // namespace meniscus::farm
