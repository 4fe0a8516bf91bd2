// SPDX-License-Identifier: BSD-3-Clause
// Checks the pointers, counts and strides that callers pass.
#include "exporters/bindings/c/caller_memory.h"

#include "core/properties/properties.h"

#include <algorithm>

namespace meniscus::c_api {

std::size_t require_rows(const void* data, const CallerRows& rows, const char* name) {
  const std::size_t row = rows.width * rows.number, stride = rows.stride == 0 ? row : rows.stride;
  if (rows.count == 0) return stride;
  require(data, name);
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  if (address % rows.number != 0)
    refuse(MENISCUS_USAGE, "{} is not aligned: its address is not a multiple of {}", name, rows.number);
  if (stride > kMostBytes)
    refuse(MENISCUS_USAGE, "{}_stride is {} bytes, which is -{} with a sign; rows must ascend", name, stride,
           ~stride + 1);
  if (stride < row || stride % rows.number != 0)
    refuse(MENISCUS_USAGE, "{}_stride is {} bytes; rows of {} numbers of {} bytes need a multiple of {}, at least {}",
           name, stride, rows.width, rows.number, rows.number, row);
  const std::size_t room = std::min<std::size_t>(kMostBytes, std::numeric_limits<std::uintptr_t>::max() - address);
  if (stride > room / rows.count)
    refuse(MENISCUS_USAGE, "{}: {} rows, {} bytes from one to the next, do not fit into memory", name, rows.count,
           stride);
  return stride;
}

void require_apart(const void* written, std::size_t written_bytes, const char* written_name, const void* read,
                   std::size_t read_bytes, const char* read_name) {
  const auto a = reinterpret_cast<std::uintptr_t>(written), b = reinterpret_cast<std::uintptr_t>(read);
  if (a < b + read_bytes && b < a + written_bytes)
    refuse(MENISCUS_USAGE, "{} and {} overlap; what is written needs room of its own", written_name, read_name);
}

void check_number(std::string_view key, const char* name, double value, const char* unit) {
  const Property& property = property_of(key);
  if (!property.is_within(value))
    refuse(MENISCUS_INPUT, "{} is {} {}; it has to be {} to {}", name, value, unit, property.lowest, property.highest);
}

}  // namespace meniscus::c_api
