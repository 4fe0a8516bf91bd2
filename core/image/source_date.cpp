// SPDX-License-Identifier: BSD-3-Clause
// Reads the time of files from the environment.
#include "core/image/source_date.h"

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace meniscus {

std::time_t source_date() {
  const char* const text = std::getenv("SOURCE_DATE_EPOCH");
  if (!text) return 0;
  std::int64_t seconds = 0;
  const std::string_view digits(text);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), seconds);
  return error == std::errc() && end == digits.data() + digits.size() ? seconds : 0;
}

}  // namespace meniscus
