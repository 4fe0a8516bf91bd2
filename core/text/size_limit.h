// SPDX-License-Identifier: BSD-3-Clause
// What is said of files that are larger than what is read.
#pragma once

#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {

[[noreturn]] inline void refuse_too_large(const std::string& path, std::size_t largest) {
  throw CapacityError(
      fmt::format("{}: holds more than {} bytes, more than this program reads", path, with_thousands(largest)));
}

}  // namespace meniscus
