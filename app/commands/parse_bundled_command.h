// SPDX-License-Identifier: BSD-3-Clause
// From the words after `farm bundle ... --` to a command.
#pragma once

#include <string>
#include <vector>

#include "app/farm/bundled_command.h"

namespace meniscus::farm {

/// Checks the words by the program's own options. Throws UsageError: no framed command, wrong options, options that a
/// bundle decides by itself; RequestError: options that a bundle does not have; what taking options throws.
BundledCommand parse_bundled_command(const std::vector<std::string>& words);

}  // namespace meniscus::farm
