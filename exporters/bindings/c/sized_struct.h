// SPDX-License-Identifier: BSD-3-Clause
// Structs that begin with their size, which callers compiled against an older or a newer header pass.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "exporters/bindings/c/caller_memory.h"

namespace meniscus::c_api {

/// Nobody's struct is smaller than its size and one field, or larger than this.
inline constexpr std::size_t kLargestStruct = 4096;

inline void check_size(std::size_t size, const char* name) {
  if (size <= sizeof(std::size_t) || size > kLargestStruct)
    refuse(MENISCUS_USAGE, "{}.size is {}; set it to sizeof({})", name, size, name);
}

/// What the caller's struct says, and `defaults` where it ends too early. Refuses what this library does not know
/// unless it is zero.
template <typename Struct>
Struct read_struct(const Struct* given, const Struct& defaults, const char* name) {
  require(given, name);
  check_size(given->size, name);
  const auto* const bytes = reinterpret_cast<const unsigned char*>(given);
  if (given->size > sizeof(Struct) &&
      std::any_of(bytes + sizeof(Struct), bytes + given->size, [](unsigned char byte) { return byte != 0; }))
    refuse(MENISCUS_USAGE, "{} asks for more than version {} of this library knows", name, MENISCUS_VERSION);
  Struct result = defaults;
  std::memcpy(&result, given, std::min(given->size, sizeof(Struct)));
  result.size = sizeof(Struct);
  return result;
}

/// Fills in as much as the caller's struct has room for.
template <typename Struct>
void write_struct(Struct* given, const Struct& value, const char* name) {
  require(given, name);
  check_size(given->size, name);
  const std::size_t size = given->size;
  std::memcpy(given, &value, std::min(size, sizeof(Struct)));
  given->size = size;
}

}  // namespace meniscus::c_api
