// SPDX-License-Identifier: BSD-3-Clause
// Which commands can be bundled, and by which steps their frames are made.
#pragma once

#include <string>
#include <vector>

#include "app/farm/bundle.h"

namespace meniscus::farm {

/// Of a command, such as {"render"} or {"export", "povray"}: its steps in order, without arguments. Throws RequestError
/// for a command that cannot be bundled.
std::vector<Step> steps_of(const std::vector<std::string>& words);

}  // namespace meniscus::farm
